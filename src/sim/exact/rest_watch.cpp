#include "sim/exact/rest_watch.h"

#include <cmath>
#include <vector>

#include "sim/record/unrest.h"

namespace carom {

bool RestWatch::at_rest(int ball) const {
    const ExactBall& b = world_.ball(ball);
    return is_asleep(b.phase()) || (b.surface >= 0 && b.kind == EventKind::kRest &&
                                    std::isinf(b.event_due) && b.piece.spin_rate.isZero(0));
}

bool RestWatch::all_at_rest() {
    // The ball that moved when last asked most likely still does.
    const std::size_t balls = world_.balls.size();
    for (std::size_t i = 0; i < balls; ++i) {
        const std::size_t ball = (awake_ + i) % balls;
        if (at_rest(static_cast<int>(ball))) continue;
        awake_ = ball;
        return false;
    }
    return true;
}

/// What a ball does, for people.
std::string RestWatch::doing(int ball) const {
    const ExactBall& b = world_.ball(ball);
    if (in_pile(b.phase())) return "moves in a pile";
    const auto on = [this](const char* verb, const Partner& partner) {
        return std::string(verb) + " on " + world_.name(partner);
    };
    if (b.surface >= 0) {
        const Partner surface{true, b.surface};
        if (!std::isinf(b.event_due)) return on("bounces", surface);
        if (b.kind == EventKind::kRest) return on("spins", surface);
        return on(b.kind == EventKind::kRoll ? "rolls" : "slides", surface);
    }
    if (b.phase() != Phase::kIsland) return "flies";
    std::string text = "moves";
    for (const Link& link : links_.of(ball))
        text += (&link == &links_.of(ball).front() ? " on " : " and ") + world_.name(link.partner);
    return text;
}

/// All that does not rest at the end.
std::string RestWatch::unrest(double end) const {
    std::vector<UnrestedBall> moving;
    for (int i = 0; i < static_cast<int>(world_.balls.size()); ++i) {
        if (at_rest(i)) continue;
        const Velocities v = world_.velocities(i, end);
        moving.push_back({world_.body(i).name, doing(i), v.linear.norm(),
                          world_.ball(i).radius * v.spin.norm()});
    }
    return unrest_text(moving, end);
}

}  // namespace carom
