#include "sim/group/pile.h"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

/// A sleeping ball wakes when something bounces off it, or presses on it with this multiple of its
/// load and weight.
constexpr double kWakeLoad = 2;

/// Impacts may make a ball that much faster before the list of pairs has to be made anew.
constexpr double kFasterByImpacts = 1.5;

}  // namespace

void Pile::want(int ball) {
    if (balls_.of(ball).wanted || balls_.is_awake(ball)) return;
    balls_.of(ball).wanted = true;
    wanted_.push_back(ball);
}

/// Makes a ball a member that is awake.
void Pile::take(int ball, double now, double wake_speed, const Links& links) {
    const bool slept = balls_.member(ball);
    balls_.add(ball, now, wake_speed);
    pairs_.add_of(ball, now, links, slept);  // asks what has held the ball
    world_.set_phase(ball, Phase::kPile);
}

void Pile::tidy() {
    balls_.tidy();
    pairs_.tidy();
}

/// Whether a pair brings a new ball into the step, or wakes one: then its own pairs have to be
/// looked at as well.
bool Pile::draws_in(const PilePair& pair, double now, const Links& links, std::vector<int>& taken) {
    const int a = pair.ball, b = pair.other.index;
    const bool parted = pair.touching && pair.gap > step_.separation_gap();
    const double reach = step_.slack(seconds_);
    for (const auto& [ball, by] : {std::pair{a, b}, std::pair{b, a}}) {
        const PileBall& it = balls_.of(ball);
        if (balls_.is_awake(ball)) continue;
        double wake_speed = 0;
        bool draws =
            !balls_.member(ball) && pair.gap < reach + std::max(pair.closing, 0.0) * seconds_;
        if (balls_.asleep(ball)) {
            const double speed = std::max(pair.closing, 0.5 * balls_.of(by).wake_speed);
            const bool hit = pair.gap < reach && speed > step_.slow_speed();
            const double weight = world_.ball(ball).mass * world_.scene.simulation.gravity.norm();
            draws = hit || parted || pair.force > kWakeLoad * (it.load + weight);
            wake_speed = hit ? speed : 0;
        }
        if (!draws) continue;
        taken.push_back(ball);
        take(ball, now, wake_speed, links);
        return true;
    }
    return false;
}

/// The same for all pairs.
bool Pile::draw_in(double now, const Links& links, std::vector<int>& taken) {
    bool any = false;
    const std::size_t known =
        pairs_.all().size();  // what is drawn in brings pairs not looked at yet
    for (std::size_t i = 0; i < known; ++i) {
        const PilePair& at = pairs_.all()[i];
        if (at.other.is_surface) continue;
        if (balls_.is_awake(at.ball) && balls_.is_awake(at.other.index)) continue;
        const PilePair pair = at;  // the list grows
        any |= draws_in(pair, now, links, taken);
    }
    return any;
}

void Pile::find_pairs(double now, const Links& links) {
    pairs_.find(now, kFasterByImpacts * fastest_ * step_.longest(), links);
}

/// The step ends before the first pair meets that is no neighbour yet.
void Pile::look_at_pairs(std::size_t first, double now) {
    for (std::size_t i = first; i < pairs_.all().size(); ++i) {
        PilePair& pair = pairs_.all()[i];
        pairs_.look_at(pair, now);
        seconds_ = step_.until_meeting(pair, pair.closing, seconds_);
    }
}

void Pile::gather(double now, const Links& links, std::vector<int>& taken) {
    balls_.begin_step(now);
    fastest_ = balls_.fastest(now) + step_.slow_speed();
    pairs_.age(now, fastest_);
    seconds_ = step_.longest();
    // Of balls that cross half of what is seen, the list is made anew; and of those that cross
    // even the widest one, the step is shorter.
    const auto travel = [&] { return 2 * kFasterByImpacts * fastest_ * seconds_; };
    if (travel() > pairs_.sight()) find_pairs(now, links);
    if (travel() > pairs_.sight()) seconds_ *= pairs_.sight() / travel();
    std::sort(wanted_.begin(), wanted_.end());
    for (const int ball : wanted_) {
        if (!balls_.of(ball).wanted || balls_.is_awake(ball)) continue;
        taken.push_back(ball);
        take(ball, now, 0, links);
    }
    wanted_.clear();
    // New balls bring new pairs, which may meet sooner.
    std::size_t seen = 0;
    do {
        const std::size_t known = pairs_.all().size();
        look_at_pairs(seen, now);
        seen = known;
    } while (draw_in(now, links, taken));
}

}  // namespace carom
