#include "sim/exact.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/failure.h"
#include "sim/effects.h"
#include "sim/exact_run.h"
#include "sim/peaks.h"

namespace carom {

namespace {

/// Events at one instant, up to this many roundings of the time, belong together.
constexpr double kSameInstant = 4 * std::numeric_limits<double>::epsilon();

/// Events without progress in time, before the run is given up. A rack of balls needs hundreds.
constexpr int kMostAtOneInstant = 100'000;

/// Events between two looks at the stop token.
constexpr std::int64_t kEventsPerLook = 1024;

}  // namespace

// ---- Start, loop, end
// ----------------------------------------------------------------------------

ExactRun::ExactRun(const Scene& scene, double end) : world_(scene), end_(end) {
    for (const Ball& b : scene.balls) motion_.ball_names.push_back(b.name);
    for (const Surface& s : scene.surfaces) motion_.surface_names.push_back(s.name);
    motion_.balls.resize(scene.balls.size());
    const int balls = static_cast<int>(scene.balls.size());
    for (int i = 0; i < balls; ++i) {
        std::vector<Contact> contacts;
        const Ball& body = world_.body(i);
        const Velocities start{body.velocity, body.spin};
        for (int s = 0; s < static_cast<int>(scene.surfaces.size()); ++s) {
            Contact c = world_.contact_at(i, {true, s}, 0);
            if (-c.depth > world_.touch_tolerance(body.position, c.point, body.radius)) continue;
            c.separation_speed = relative_velocity(c, start, {}).dot(c.normal);
            contacts.push_back(c);
        }
        settle(i, 0, start, contacts, body.velocity.norm(), true);
    }
    for (int i = 0; i < balls; ++i) predict(i, 0);
}

bool ExactRun::current(const Prediction& p) const { return world_.ball(p.ball).stamp == p.stamp; }

void ExactRun::run(const std::stop_token& stop, const SimulationProgress& progress,
                   bool until_rest) {
    double last = -1;
    int at_one_instant = 0;
    for (std::int64_t events = 0; !queue_.empty(); ++events) {
        const Prediction next = queue_.top();
        if (next.time > end_) break;
        queue_.pop();
        if (!current(next)) continue;
        at_one_instant = next.time > last ? 0 : at_one_instant + 1;
        if (at_one_instant > kMostAtOneInstant)
            refuse("more events at one instant than can be resolved", next.ball, next.partner,
                   next.time);
        last = std::max(last, next.time);

        std::vector<Prediction> together = {next};
        while (!queue_.empty() && queue_.top().time <= next.time * (1 + kSameInstant)) {
            if (current(queue_.top())) together.push_back(queue_.top());
            queue_.pop();
        }
        happen(together, next.time);
        if (until_rest && all_at_rest()) {
            end_ = next.time;
            break;
        }
        if (events % kEventsPerLook != 0) continue;
        if (stop.stop_requested())
            throw Failure(FailureKind::kRun,
                          fmt::format("interrupted at {} s of motion", next.time));
        if (progress) progress(next.time);
    }
    motion_.duration = end_;
}

bool ExactRun::all_at_rest() const {
    return std::all_of(world_.balls.begin(), world_.balls.end(), [](const ExactBall& b) {
        return b.surface >= 0 && b.kind == EventKind::kRest && std::isinf(b.row_due);
    });
}

SimulationResult ExactRun::finish() {
    motion_.peaks = find_peaks(world_.scene, motion_);
    report_.effects = effects_of(world_.scene, world_.pairs);
    return {std::move(motion_), std::move(report_)};
}

void ExactRun::refuse(const std::string& what, int ball, const Partner& partner, double now) const {
    const std::string with = partner.index >= 0 ? fmt::format(" and {}", world_.name(partner)) : "";
    throw Failure(FailureKind::kRun,
                  fmt::format("method exact, at {} s, {}{}: {}; use simulation.method: fixed", now,
                              world_.body(ball).name, with, what));
}

// ---- Events
// --------------------------------------------------------------------------------------

void ExactRun::happen(const std::vector<Prediction>& together, double now) {
    std::vector<Contact> seeds;
    for (const Prediction& p : together) {
        if (!current(p)) continue;
        if (!p.impact) {
            end_phase(p.ball, now);
            continue;
        }
        // The partner has moved on since: its own prediction has replaced this one.
        if (!p.partner.is_surface && world_.ball(p.partner.index).stamp != p.partner_stamp) {
            predict(p.ball, now);
            continue;
        }
        seeds.push_back(world_.contact_at(p.ball, p.partner, now));
    }
    // Clusters that do not touch are resolved one by one.
    std::vector<char> done(world_.balls.size(), 0);
    for (const Contact& seed : seeds) {
        if (done[static_cast<std::size_t>(seed.ball)] != 0) continue;
        Cluster cluster(world_, seed, seeds, now);
        for (const int ball : cluster.balls()) done[static_cast<std::size_t>(ball)] = 1;
        std::vector<Contact> impacts;
        cluster.resolve(solver_, impacts);
        write_impacts(impacts, now);
        for (const int ball : cluster.balls()) {
            const ImpactBody& body = cluster.body(ball);
            settle(ball, now, body.velocities, cluster.contacts_of(ball), cluster.first_approach(),
                   false);
        }
        for (const int ball : cluster.balls()) predict(ball, now);
    }
}

void ExactRun::write_impacts(const std::vector<Contact>& impacts, double now) {
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

void ExactRun::row(double now, EventKind kind, int ball) {
    const ExactBall& b = world_.ball(ball);
    Event e;
    e.time = now;
    e.ball = ball;
    e.other = {true, b.surface};
    e.kind = kind;
    e.normal = b.normal;
    e.point = world_.state(ball, now).position - world_.body(ball).radius * b.normal;
    motion_.events.push_back(e);
}

void ExactRun::end_phase(int ball, double now) {
    ExactBall& b = world_.ball(ball);
    if (b.row_due <= now) {
        b.row_due = std::numeric_limits<double>::infinity();
        row(now, b.kind, ball);
    }
    if (b.phase_end > now) {
        b.stamp = next_stamp_++;
        predict(ball, now);
        return;
    }
    const BallState state = world_.state(ball, now);
    const Contact contact = world_.contact_at(ball, {true, b.surface}, now);
    if (b.leaves_at_end) {
        row(now, EventKind::kLeave, ball);
        fly(ball, now, {state.velocity, state.spin});
    } else {
        hold(ball, now, contact, {state.velocity, state.spin}, 0, false);
    }
    predict(ball, now);
}

SimulationResult simulate_exact(const Scene& scene, const std::stop_token& stop,
                                const SimulationProgress& progress) {
    const Simulation& s = scene.simulation;
    ExactRun run(scene, s.duration.value_or(s.max_duration));
    run.run(stop, progress, !s.duration);
    return run.finish();
}

}  // namespace carom
