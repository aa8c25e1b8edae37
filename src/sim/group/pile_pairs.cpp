// Who belongs to a pile, and who is near whom in it.
#include <algorithm>
#include <cmath>

#include "geometry/nearest.h"
#include "sim/group/pile.h"

namespace carom {

namespace {

/// The longest step of a pile [s], and how often it may be halved.
constexpr double kLongestStep = 1.0 / 1000;
constexpr int kMostHalvings = 12;

/// A pair closes by at most this part of its smaller radius in a step, so that a rebound at the
/// step's start is early by no more than that.
constexpr double kStepOfRadius = 0.03;

/// Pairs up to this gap, as a part of the smallest radius, are kept from step to step.
constexpr double kSkinOfRadius = 0.4;

/// Gaps of up to this part of the smallest radius are looked at in any case.
constexpr double kLeastSlack = 1e-4;

/// A sleeping ball wakes when something bounces off it, or presses on it with this multiple of its
/// load and weight.
constexpr double kWakeLoad = 2;

/// A touching pair of which one sleeps has parted when its gap is above this part of the smallest
/// radius: its support may be gone.
constexpr double kParted = 1e-3;

}  // namespace

Pile::Pile(ExactWorld& world)
    : world_(world),
      balls_(world.balls.size()),
      bodies_(world.balls.size()),
      shift_(world.balls.size(), Vec3::Zero()) {
    smallest_radius_ = INFINITY;
    for (const Ball& b : world.scene.balls) smallest_radius_ = std::min(smallest_radius_, b.radius);
    skin_ = kSkinOfRadius * smallest_radius_;
    const double g = world.scene.simulation.gravity.norm();
    longest_ = kLongestStep;
    for (int i = 0; i < kMostHalvings; ++i)
        if (g * longest_ * longest_ > kStepOfRadius * smallest_radius_) longest_ *= 0.5;
}

double Pile::slow_speed() const { return 2 * world_.scene.simulation.gravity.norm() * longest_; }

double Pile::separation_gap() const { return kParted * smallest_radius_; }

Vec3 Pile::position_of(int ball, double now) const {
    return member(ball) ? of(ball).at.position : world_.position(ball, now);
}

Vec3 Pile::velocity_of(int ball, double now) const {
    return member(ball) ? of(ball).at.velocity : world_.velocities(ball, now).linear;
}

// ---- Members
// ------------------------------------------------------------------------------------

void Pile::want(int ball) {
    if (of(ball).wanted || is_awake(ball)) return;
    of(ball).wanted = true;
    wanted_.push_back(ball);
}

/// Makes a ball a member that is awake.
void Pile::take(int ball, double now, double wake_speed, const Links& links) {
    PileBall& b = of(ball);
    const bool known = member(ball);  // it slept: its pairs with those awake are there already
    b.wanted = false;
    b.wake_speed = wake_speed;
    b.lone_steps = 0;
    b.calm_seconds = 0;
    b.at = world_.state(ball, now);
    const ExactBall& body = world_.ball(ball);
    bodies_[static_cast<std::size_t>(ball)] = {b.at.velocity, body.radius * b.at.spin,
                                               1 / body.mass, 1 / (body.inertia_factor * body.mass),
                                               0};
    awake_.insert(std::lower_bound(awake_.begin(), awake_.end(), ball), ball);
    add_pairs_of(ball, now, links, known);  // asks what has held the ball
    world_.set_phase(ball, Phase::kPile);
}

void Pile::lay_to_sleep(int ball) {
    PileBall& b = of(ball);
    b.at.velocity.setZero();
    PileBody& as_body = body(ball);
    as_body.velocity.setZero();
    as_body.inverse_mass = as_body.inverse_spin = 0;
}

void Pile::tidy() {
    std::erase_if(awake_, [this](int ball) { return !is_awake(ball); });
    // Of two sleepers nothing is to be solved; the pair is found again when one wakes.
    std::erase_if(pairs_, [this](const PilePair& p) {
        return !is_awake(p.ball) && (p.other.is_surface || !is_awake(p.other.index));
    });
}

// ---- Pairs
// --------------------------------------------------------------------------------------

/// The pairs of a ball that are not in the list: a member that is awake has its own there.
void Pile::add_pairs_of(int ball, double now, const Links& links, bool slept) {
    const std::size_t first = pairs_.size();
    const Vec3 x = of(ball).at.position;
    const ExactBall& body = world_.ball(ball);
    const auto add = [&](int a, const Partner& partner, int material) {
        PilePair pair;
        pair.ball = a;
        pair.other = partner;
        const PairProperties both = world_.pair(world_.ball(a).material, material);
        pair.restitution = both.restitution;
        pair.friction = both.friction;
        if (const Link* link = links.find(a, partner)) {
            pair.kind.take_over(link->kind.stated());
            if (link->kind.from_start()) pair.kind.begins_at_start();
        } else if (const ExactBall& held = world_.ball(a);
                   partner.is_surface && held.surface == partner.index) {
            pair.kind.take_over(std::isinf(held.event_due) ? held.kind : EventKind::kLeave);
        } else if (slept) {
            pair.kind.take_over(EventKind::kRest);
        }
        if (now == 0) pair.kind.begins_at_start();
        pairs_.push_back(pair);
    };
    world_.for_each_surface_near(ball, x, body.radius + skin_, [&](int s) {
        const Surface& surface = world_.surface(s);
        if (nearest_on(surface.shape, x, body.radius).gap < skin_)
            add(ball, {true, s}, surface.material);
    });
    const auto near = [&](int other) {
        if (is_awake(other) && !of(other).waits) return;
        const double reach = skin_ + body.radius + world_.ball(other).radius;
        if ((x - position_of(other, now)).squaredNorm() >= reach * reach) return;
        add(std::min(ball, other), {false, std::max(ball, other)}, world_.ball(other).material);
    };
    if (world_.balls_can_meet && world_.grid)
        world_.grid->for_each_touching(ball, x, body.radius + skin_, near);
    else
        world_.for_each_near(ball, near);
    std::sort(pairs_.begin() + static_cast<std::ptrdiff_t>(first), pairs_.end(),
              [](const PilePair& a, const PilePair& b) { return a.key() < b.key(); });
}

/// All pairs anew; what was known of the old ones stays.
void Pile::find_pairs(double now, const Links& links) {
    const auto by_key = [](const PilePair& a, const PilePair& b) { return a.key() < b.key(); };
    std::swap(pairs_, old_pairs_);
    std::sort(old_pairs_.begin(), old_pairs_.end(), by_key);
    pairs_.clear();
    // Only members that still wait for their turn are looked at: so each pair comes up once.
    for (const int ball : awake_) of(ball).waits = true;
    for (const int ball : awake_) {
        add_pairs_of(ball, now, links, false);
        of(ball).waits = false;
    }
    std::sort(pairs_.begin(), pairs_.end(), by_key);
    auto old = old_pairs_.begin();
    for (PilePair& pair : pairs_) {
        while (old != old_pairs_.end() && old->key() < pair.key()) ++old;
        if (old != old_pairs_.end() && old->key() == pair.key()) pair = *old;
    }
    moved_ = 0;
}

/// Where the two stand, and how fast they close.
void Pile::look_at(PilePair& pair, double now) {
    const Vec3 x = position_of(pair.ball, now), v = velocity_of(pair.ball, now);
    const double radius = world_.ball(pair.ball).radius;
    if (pair.other.is_surface) {
        const Nearest nearest = nearest_on(world_.surface(pair.other.index).shape, x, radius);
        pair.normal = nearest.normal;
        pair.gap = nearest.gap;
        pair.closing = -v.dot(nearest.normal);
    } else {
        const Vec3 apart = x - position_of(pair.other.index, now);
        const double distance = apart.norm();
        pair.normal = distance > 0 ? Vec3(apart / distance) : Vec3::UnitZ();
        pair.gap = distance - radius - world_.ball(pair.other.index).radius;
        pair.closing = -(v - velocity_of(pair.other.index, now)).dot(pair.normal);
    }
    if (pair.closing * longest_ <= pair.gap) return;
    fastest_closing_ = std::max(fastest_closing_, pair.closing);
}

void Pile::choose_seconds() {
    seconds_ = longest_;
    for (int i = 0; i < kMostHalvings; ++i)
        if (fastest_closing_ * seconds_ > kStepOfRadius * smallest_radius_) seconds_ *= 0.5;
    slack_ = kLeastSlack * smallest_radius_ + fastest_closing_ * seconds_ +
             world_.scene.simulation.gravity.norm() * seconds_ * seconds_;
}

/// Whether a pair brings a new ball into the step, or wakes one: then its own pairs have to be
/// looked at as well.
bool Pile::draws_in(const PilePair& pair, double now, const Links& links, std::vector<int>& taken) {
    if (pair.other.is_surface) return false;
    const int a = pair.ball, b = pair.other.index;
    const bool parted = pair.touching && pair.gap > separation_gap();
    for (const auto& [ball, by] : {std::pair{a, b}, std::pair{b, a}}) {
        const PileBall& it = of(ball);
        if (is_awake(ball)) continue;
        double wake_speed = 0;
        bool draws = !member(ball) && pair.gap < slack_;
        if (asleep(ball)) {
            const double speed = std::max(pair.closing, 0.5 * of(by).wake_speed);
            const bool hit = pair.gap < slack_ && speed > slow_speed();
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

void Pile::gather(double now, const Links& links, std::vector<int>& taken) {
    for (const int ball : awake_) {
        PileBall& b = of(ball);
        b.at = world_.state(ball, now);
        b.wake_speed = 0;
        PileBody& as_body = body(ball);
        as_body.velocity = b.at.velocity;
        as_body.rim = world_.ball(ball).radius * b.at.spin;
    }
    double fastest = 0;
    for (int i = 0; i < static_cast<int>(balls_.size()); ++i)
        if (!asleep(i)) fastest = std::max(fastest, velocity_of(i, now).squaredNorm());
    const double step = (std::sqrt(fastest) + slow_speed()) * longest_;
    moved_ += 2 * step;
    if (moved_ + 2 * step > skin_) find_pairs(now, links);
    std::sort(wanted_.begin(), wanted_.end());
    for (const int ball : wanted_) {
        if (!of(ball).wanted || is_awake(ball)) continue;
        taken.push_back(ball);
        take(ball, now, 0, links);
    }
    wanted_.clear();

    // New balls bring new pairs, which may be faster and reach further.
    fastest_closing_ = 0;
    std::size_t seen = 0;
    for (bool more = true; more;) {
        for (; seen < pairs_.size(); ++seen) look_at(pairs_[seen], now);
        choose_seconds();
        more = false;
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            const PilePair& at = pairs_[i];
            if (at.other.is_surface || (is_awake(at.ball) && is_awake(at.other.index))) continue;
            const PilePair pair = at;  // what is drawn in makes the list grow
            more |= draws_in(pair, now, links, taken);
        }
    }
}

}  // namespace carom
