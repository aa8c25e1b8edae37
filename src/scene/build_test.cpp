// The drop test of one ball.
#include "scene/build.h"

#include <fmt/format.h>

#include "scene/scalar.h"

namespace carom {

namespace {

/// Index of the ball that a test names; -1 if there is none.
int tested_ball(Build& build, const Node& reference) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < build.scene.balls.size(); ++i) {
        names.push_back(build.scene.balls[i].name);
        if (names.back() == reference.text) return static_cast<int>(i);
    }
    build.report.error(reference,
                       fmt::format("there is no ball {}{}", quoted_excerpt(reference.text),
                                   suggestion(reference.text, names)));
    return -1;
}

}  // namespace

void build_test(Build& build) {
    const Node* node = build.root.find("test");
    if (node == nullptr || node->kind != Node::Kind::kMap) return;
    const Fields fields = build.top().child("test");
    const Node* rebound = fields.find("rebound");
    const Node* ball = fields.find("ball");
    if (rebound == nullptr || ball == nullptr) return;  // reported by the validator
    ReboundTest test;
    test.ball = tested_ball(build, *ball);
    const Vec2 bounds = fields.vec2("rebound");
    test.low_m = bounds[0];
    test.high_m = bounds[1];
    if (test.high_m <= test.low_m)
        build.report.error(*rebound, "'rebound' must be a lower and then a higher height");
    test.to_top = fields.word("rebound_to") == "top";
    test.rule = fields.maybe_word("rule").value_or("");
    if (test.ball >= 0) build.scene.test = std::move(test);
}

}  // namespace carom
