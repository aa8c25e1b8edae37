#include "sim/exact/exact.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/failure.h"
#include "sim/exact/refusal.h"
#include "sim/exact/run.h"
#include "sim/group/island_step.h"
#include "sim/record/kept_limit.h"
#include "sim/record/model_features.h"
#include "sim/record/peaks.h"
#include "sim/world/seams.h"

namespace carom {

namespace {

/// Events at one instant, up to this many roundings of the time, belong together.
constexpr double kTogether = 4 * std::numeric_limits<double>::epsilon();

/// Events without progress in time, before a ball is stepped instead. A rack of balls needs
/// hundreds, one ball by itself hardly any. Where even that does not help, the run is given up.
constexpr int kMostAtOneInstant = 20'000;
constexpr int kMostOfOneBall = 200;
constexpr int kMostGivenUpAtOnce = 1000;

/// Impacts with a larger coefficient do not make a pile: a dense gas of balls that lose hardly
/// anything is followed impact by impact, so that its energy is kept.
constexpr double kMostOfPile = 0.9;

/// Events between two looks at the stop token, where nothing is stepped or integrated, which takes
/// a hundred times as long.
constexpr std::int64_t kEventsPerLook = 1024;

/// Counts events at one instant.
class Standstill {
  public:
    /// Whether the next event is one too many; a step of a pile, which gets on by itself, is none.
    bool stuck(const Prediction& next) {
        of_one_ball_ = next.ball == ball_ ? of_one_ball_ + 1 : 0;
        ball_ = next.ball;
        if (++events_ <= kMostAtOneInstant && of_one_ball_ <= kMostOfOneBall) return false;
        of_one_ball_ = 0;
        ++given_up_;
        return true;
    }
    bool is_hopeless() const { return given_up_ > kMostGivenUpAtOnce; }

  private:
    int events_ = 0, of_one_ball_ = 0, ball_ = -1, given_up_ = 0;
};

}  // namespace

// ---- Start, loop, end
// ----------------------------------------------------------------------------

ExactRun::ExactRun(const Scene& scene, double end, const ExactOptions& options)
    : world_(scene),
      end_(end),
      links_(scene.balls.size()),
      pile_(world_),
      queue_(scene.balls.size()),
      log_(scene.balls.size()),
      next_(scene.balls.size()),
      can_collide_(can_collide(scene, world_.pairs, end)),
      cluster_(world_),
      seeds_(scene.balls.size()) {
    world_.place_rounding = options.place_rounding;
    for (const Ball& b : scene.balls) motion_.ball_names.push_back(b.name);
    for (const Surface& s : scene.surfaces) motion_.surface_names.push_back(s.name);
    motion_.balls.resize(scene.balls.size());
    if (world_.bounded_surfaces.size() >= options.surfaces_for_tree) world_.build_surface_tree();
    const int balls = static_cast<int>(scene.balls.size());
    for (int i = 0; i < balls; ++i) {
        std::vector<Contact> contacts;
        const Ball& body = world_.body(i);
        const Velocities start{body.velocity, body.spin};
        world_.for_each_surface_near(i, body.position, world_.reach(i), [&](int s) {
            Contact c = world_.contact_at(i, {true, s}, 0);
            if (-c.depth > world_.touch_tolerance(body.position, c.point, body.radius)) return;
            c.separation_speed = relative_velocity(c, start, {}).dot(c.normal);
            contacts.push_back(c);
        });
        merge_places(world_, body.position, start, contacts, 0,
                     [](const Contact&, const Contact&) {});
        if (rules_.approaches_at_start(i, contacts))
            begin_flight(i, 0, start);  // into an impact at once
        else
            settle(i, 0, start, contacts, body.velocity.norm(), true);
    }
    world_.balls_can_meet = can_collide_.possible;
    if (can_collide_.possible && scene.balls.size() >= options.balls_for_grid) world_.build_grid(0);
    for (int i = 0; i < balls; ++i) predict(i, 0);
}

bool ExactRun::current(const Prediction& p) const { return world_.ball(p.ball).stamp == p.stamp; }

/// What the ball's entry in the list of events stands for.
Prediction ExactRun::due(int ball) const {
    Prediction p = next_[static_cast<std::size_t>(ball)];
    if (p.leaves_cell < p.time) {
        p.time = p.leaves_cell;
        p.kind = PredictionKind::kCell;
    }
    return p;
}

void ExactRun::run(const std::stop_token& stop, const SimulationProgress& progress,
                   bool until_rest) {
    double last = -1;
    Standstill standstill;
    std::int64_t looked = 0;  // how much that takes long had been done
    for (std::int64_t events = 0;; ++events) {
        const EventQueue::Entry first = queue_.first();
        const bool step = next_step_ <= first.time;
        if (std::min(next_step_, first.time) > end_) {
            if (until_rest) report_.unrest = unrest();
            break;
        }
        Prediction next;
        if (step) {
            next.time = next_step_;
            next.ball = pile_.awake().empty() ? 0 : pile_.awake().front();
        } else {
            next = due(first.ball);
            queue_.drop(first.ball);
            fetch(queue_.first().ball);  // most likely the next one
            if (!current(next)) continue;
        }
        if (next.time > last) standstill = {};
        const bool stuck = next.time <= last && standstill.stuck(next);
        last = std::max(last, next.time);

        if (step) {
            step_pile(next.time);
        } else if (stuck) {
            if (standstill.is_hopeless())
                refuse(world_, "more events at one instant than can be resolved", next.ball,
                       next.partner, next.time);
            give_up_on(next);
        } else {
            take_together(next);
            process_instant(next.time);
        }
        fit_grid(next.time);
        if (until_rest && all_at_rest()) {
            end_ = next.time;
            break;
        }
        const std::int64_t slow = report_.steps + report_.integrated + (step ? events : 0);
        if (slow == looked && events % kEventsPerLook != 0) continue;
        looked = slow;
        require_room(
            motion_.events.size() + static_cast<std::size_t>(report_.impacts + report_.integrated),
            next.time, end_);
        if (stop.stop_requested())
            throw Failure(FailureKind::kRun,
                          fmt::format("interrupted at {} s of motion", next.time));
        if (progress) progress(next.time);
    }
    motion_.duration = end_;
}

/// Has what an event reads first on its way.
void ExactRun::fetch(int ball) const {
    if (!world_.grid || ball < 0) return;
    __builtin_prefetch(&next_[static_cast<std::size_t>(ball)]);
    world_.fetch(ball);
    world_.grid->fetch(ball);
}

/// The next prediction, and the others of its instant.
void ExactRun::take_together(const Prediction& next) {
    together_.assign(1, next);
    while (queue_.first().time <= next.time * (1 + kTogether)) {
        const int ball = queue_.first().ball;
        const Prediction p = due(ball);
        if (current(p)) together_.push_back(p);
        queue_.drop(ball);
    }
}

SimulationResult ExactRun::finish() {
    log_.move_into(motion_.balls);
    motion_.peaks = find_peaks(world_.scene, motion_);
    report_.effects = effects_of(world_.scene, world_.pairs);
    report_.effects["pairs"] = {can_collide_.possible, can_collide_.why};
    report_.effects["islands"] =
        report_.integrated + report_.steps > 0
            ? Effect{true, fmt::format("contacts act on each other: {} pieces integrated, {} steps "
                                       "of ODE",
                                       report_.integrated, report_.steps)}
            : Effect{false, "no two lasting contacts of a ball at the same time"};
    report_.effects["last_resort"] =
        report_.given_up > 0
            ? Effect{true, fmt::format("{} times a contact that could not be integrated, or whose "
                                       "events had no end, was stepped by ODE for a while",
                                       report_.given_up)}
            : Effect{false, "no contact was given up on"};
    return {std::move(motion_), std::move(report_)};
}

// ---- Events
// --------------------------------------------------------------------------------------

void ExactRun::process_instant(double now) {
    seeds_.clear();
    stepped_.clear();
    ++instant_;
    for (std::size_t i = 0; i < together_.size(); ++i) {
        const Prediction p = together_[i];
        if (!current(p)) continue;
        if (p.kind == PredictionKind::kCell) {
            change_cell(p.ball, now);
        } else if (p.kind == PredictionKind::kPhase) {
            if (world_.ball(p.ball).stepped)
                stepped_.push_back(p.ball);
            else
                end_phase(p.ball, now);
        } else if (!p.partner.is_surface && world_.ball(p.partner.index).stamp != p.partner_stamp) {
            predict(p.ball, now);  // the partner has moved on since
        } else if (meets_pile(p)) {
            pile_.want(world_.ball(p.ball).in_pile ? p.partner.index : p.ball);
            next_step_ = now;
        } else {
            seeds_.add(contact_met(p, now));
        }
    }
    const std::size_t met = seeds_.all().size();
    // What hangs on a link is met as well.
    const auto has_links = [this](int ball) {
        return has_island(world_.ball(ball)) && !links_.of(ball).empty();
    };
    const auto linked = [&has_links](const Contact& c) {
        return has_links(c.ball) || (!c.other.is_surface && has_links(c.other.index));
    };
    if (std::any_of(seeds_.all().begin(), seeds_.all().end(), linked))
        for (const Contact& c : linked_contacts(seeds_.all(), now)) seeds_.add(c);
    // Clusters that do not touch are resolved one by one.
    for (std::size_t i = 0; i < met; ++i) {
        const Contact seed = seeds_.all()[i];
        if (world_.ball(seed.ball).resolved != instant_) resolve(seed, now);
    }
    if (!stepped_.empty()) step_islands(stepped_, now);
}

/// Events of a ball that have no end in time: it is stepped, as is what it meets.
void ExactRun::give_up_on(const Prediction& p) {
    for (const int ball : {p.ball, p.partner.is_surface ? -1 : p.partner.index}) {
        if (ball < 0 || world_.ball(ball).in_pile) continue;
        IntegratedPhase& phase = integrated_[ball];
        phase.state = {world_.position(ball, p.time), world_.velocities(ball, p.time).linear,
                       world_.velocities(ball, p.time).spin};
        step_instead(ball, p.time);
        predict(ball, p.time);
    }
}

/// The contact of an impact that has come. On a surface the ball takes what rounding left of the
/// gap and of the time: late in a bouncing series a hop is short against the time's last digit, and
/// g times that digit is much against its speed.
Contact ExactRun::contact_met(const Prediction& p, double now) {
    ExactBall& b = world_.ball(p.ball);
    put_on_surface(p.ball, now);
    if (!p.partner.is_surface) put_on_surface(p.partner.index, now);
    if (p.partner.is_surface && !b.stepped && !b.piece.curve) {
        const double lost = p.seconds - (now - b.piece.start);
        b.piece.position += lost * world_.velocities(p.ball, now).linear;
        b.piece.velocity += lost * b.piece.acceleration;
        Contact met = world_.contact_at(p.ball, p.partner, now);
        b.piece.position += met.depth * met.normal;
        met.depth = 0;
        return met;
    }
    return world_.contact_at(p.ball, p.partner, now);
}

void ExactRun::resolve(const Contact& seed, double now) {
    cluster_.gather(seed, seeds_, now);
    impacts_.clear();
    const ImpactCluster::Limits limits = limits_of(cluster_);
    cluster_.resolve(solver_, impacts_, limits);
    const double rounding_speed =
        std::max(cluster_.rounding_speed(), limits.enough < slow_speed(world_) ? limits.enough : 0);
    add_impact_events(impacts_, now);
    for (const int ball : cluster_.balls()) {
        world_.ball(ball).resolved = instant_;
        world_.ball(ball).rounding_speed = rounding_speed;
    }
    settle_cluster(cluster_, now);
    const bool lossy = std::any_of(impacts_.begin(), impacts_.end(),
                                   [](const Contact& c) { return c.restitution <= kMostOfPile; });
    for (const int ball : cluster_.balls()) {
        if (lossy) note_impact(ball, now);
        predict(ball, now);
    }
}

void ExactRun::add_impact_events(const std::vector<Contact>& impacts, double now) {
    for (const Contact& c : impacts) {
        Event e;
        e.time = now;
        e.ball = c.ball;
        e.other = c.other;
        e.kind = EventKind::kImpact;
        e.point = c.point;
        e.normal = c.normal;
        e.approach_speed = std::max(c.approach_speed, 0.0);
        e.separation_speed = std::max(c.separation_speed, 0.0);
        e.restitution = c.restitution;
        e.impulse = c.impulse;
        e.tangential_impulse = c.tangential_impulse;
        motion_.events.push_back(e);
        ++report_.impacts;
    }
}

void ExactRun::add_event(double now, EventKind kind, int ball) {
    const ExactBall& b = world_.ball(ball);
    Event e;
    e.time = now;
    e.ball = ball;
    e.other = {true, b.surface};
    e.kind = kind;
    e.normal = b.normal;
    e.point = world_.state(ball, now).position - world_.ball(ball).radius * b.normal;
    motion_.events.push_back(e);
}

void ExactRun::end_phase(int ball, double now) {
    ExactBall& b = world_.ball(ball);
    if (b.event_due <= now) {
        b.event_due = std::numeric_limits<double>::infinity();
        add_event(now, b.kind, ball);
    }
    if (b.phase_end > now) {
        b.stamp = next_stamp_++;
        predict(ball, now);
        return;
    }
    const Velocities velocities = world_.velocities(ball, now);
    if (b.piece.curve)
        end_integrated(ball, now);
    else if (const Contact c = world_.contact_at(ball, {true, b.surface}, now); !b.leaves_at_end)
        begin_contact(ball, now, c, velocities, 0, false);
    else if (!go_over_seam(ball, now, velocities))
        begin_integrated(ball, now, c, velocities, 0, false);
    predict(ball, now);
}

SimulationResult simulate_exact(const Scene& scene, const std::stop_token& stop,
                                const SimulationProgress& progress, const ExactOptions& options) {
    const Simulation& s = scene.simulation;
    ExactRun run(scene, s.duration.value_or(s.max_duration), options);
    run.run(stop, progress, !s.duration);
    return run.finish();
}

}  // namespace carom
