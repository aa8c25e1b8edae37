// The drop test of one ball.
#include "scene/build.h"

#include <utility>

namespace carom {

void build_test(Build& build) {
    const Node* node = build.root.find("test");
    if (node == nullptr || node->kind != Node::Kind::kMap) return;
    const Fields fields = build.top().child("test");
    const Node* rebound = fields.find("rebound");
    const Node* ball = fields.find("ball");
    if (rebound == nullptr || ball == nullptr) return;  // reported by the validator
    ReboundTest test;
    test.ball = resolve_ball(build, *ball);
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
