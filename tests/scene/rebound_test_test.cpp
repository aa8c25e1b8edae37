// The keys of a drop test, and the ruler's band.
#include "scene_testing.h"

namespace carom {
namespace {

std::string with(const std::string& lines) {
    return "carom: 1\nballs:\n  - {name: a, radius: 0.1, position: [0, 0, 1]}\n"
           "  - {name: other, radius: 0.1, position: [1, 0, 1]}\n" +
           lines;
}

TEST(ReboundTestKeys, AreRead) {
    const Scene scene = scene_of(
        with("test: {ball: other, rebound: [0.24, 0.26], rebound_to: top, rule: \"ITTF T3\"}\n"
             "overlay: {ruler: {band: [0.24, 0.26]}}\n"));
    ASSERT_TRUE(scene.test);
    EXPECT_EQ(1, scene.test->ball);
    EXPECT_EQ(0.24, scene.test->low_m);
    EXPECT_EQ(0.26, scene.test->high_m);
    EXPECT_TRUE(scene.test->to_top);
    EXPECT_EQ("ITTF T3", scene.test->rule);
    ASSERT_TRUE(scene.overlay.ruler->band);
    EXPECT_EQ(0.26, (*scene.overlay.ruler->band)[1]);
}

TEST(ReboundTestKeys, AreLeftOutAndDefault) {
    EXPECT_FALSE(scene_of(with("")).test);
    const Scene scene = scene_of(with("test: {ball: a, rebound: [0, 1]}\n"));
    EXPECT_FALSE(scene.test->to_top);
    EXPECT_EQ("", scene.test->rule);
}

TEST(ReboundTestKeys, MistakesAreFound) {
    const auto holds = [](const std::string& lines, const std::string& part) {
        const std::string found = errors_of(with(lines));
        EXPECT_NE(std::string::npos, found.find(part)) << found;
    };
    holds("test: {ball: othre, rebound: [0, 1]}\n",
          "t.yaml:5:14: error: there is no ball 'othre'; did you mean 'other'?");
    holds("test: {ball: a, rebound: [1, 0.5]}\n", "5:26: error: 'rebound' must be a lower");
    holds("test: {ball: a, rebound: [1, 1]}\n", "'rebound' must be a lower");
    holds("test: {ball: a, rebound: [-1, 1]}\n", "'rebound' must be at least 0");
    holds("test: {ball: a, rebound: 1}\n", "'rebound' must be");
    holds("test: {ball: a}\n", "the key 'rebound' is missing");
    holds("test: {rebound: [0, 1]}\n", "the key 'ball' is missing");
    holds("test: {ball: a, rebound: [0, 1], rebound_to: middle}\n", "'rebound_to' must be");
    holds("test: {ball: a, rebound: [0, 1], of: top}\n", "unknown key 'of'");
    holds("test: true\n", "'test' must be a mapping");
    holds("overlay: {ruler: {band: [1, 0]}}\n", "the ruler's 'band'");
}

}  // namespace
}  // namespace carom
