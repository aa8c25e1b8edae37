// What a hostile scene may cost: it is refused, or looked at less closely, before the machine
// suffers.
#include "core/monotone_curve.h"
#include "scene/overlap.h"
#include "scene/restitution_law.h"
#include "scene_testing.h"

namespace carom {
namespace {

TEST(Bounds, ManyMistakesInOneLongLineKeepNoCopiesOfIt) {
    std::string text = "carom: 1\nballs: [";
    for (int i = 0; i < 20000; ++i) text += "{nam: a, radios: x},";
    const SceneResult result = read_scene(text + "]\n", "t.yaml");
    std::size_t kept = 0;
    for (const Diagnostic& d : result.diagnostics.items()) kept += d.source_line.size();
    EXPECT_EQ(result.diagnostics.items().size(), 1001U);
    EXPECT_LE(kept, 20'000'000U);  // of 400 MB
    const std::string shown = result.diagnostics.items()[20].shown();
    EXPECT_NE(shown.find("...nam: a, radios: x},{nam: a"), std::string::npos) << shown;
    EXPECT_NE(shown.find(" ^~~"), std::string::npos) << shown;
}

/// `count` planes under 100,000 balls.
std::string balls_over_planes(int count) {
    std::string text = "carom: 1\nsurfaces:\n";
    for (int i = 0; i < count; ++i)
        text +=
            "- {name: s" + std::to_string(i) + ", plane: {offset: -" + std::to_string(i) + "}}\n";
    return text +
           "balls: [{name: a, radius: 0.1, position: [0, 0, 1], repeat: {count: [100, 100, 10], "
           "spacing: 0.3}}]\n";
}

TEST(Bounds, BallsTimesSurfaces) {
    EXPECT_EQ(errors_of(balls_over_planes(20)), "");
    const std::string errors = errors_of(balls_over_planes(1000));
    EXPECT_NE(errors.find("100000 balls and 1000 surfaces make more than 30000000 pairs"),
              std::string::npos)
        << errors;
    EXPECT_EQ(errors.find('\n'), errors.size() - 1) << errors;
}

TEST(Bounds, LongTablesAreLookedAtBetweenAllTheirEntries) {
    // Rises nowhere but between two entries far inside, where the separation speed falls.
    std::vector<double> speeds, values;
    for (int i = 0; i < 50'000; ++i) {
        speeds.push_back(1 + 0.001 * i);
        values.push_back(i < 40'000 ? 0.9 : 0.5);
    }
    const auto falls = falling_separation(MonotoneCurve(speeds, values));
    ASSERT_TRUE(falls);
    EXPECT_NEAR(falls->from, speeds[40'000], 0.0011);
    values.assign(values.size(), 0.7);
    EXPECT_FALSE(falling_separation(MonotoneCurve(speeds, values)));
}

}  // namespace
}  // namespace carom
