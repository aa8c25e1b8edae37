#include "sim/fixed/fixed.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/failure.h"
#include "sim/contact/contact_laws.h"
#include "sim/contact/rolling_resistance.h"
#include "sim/fixed/contact_finder.h"
#include "sim/fixed/contact_solver.h"
#include "sim/fixed/ode_world.h"
#include "sim/law/air_force.h"
#include "sim/record/event_log.h"
#include "sim/record/kept_limit.h"
#include "sim/record/model_features.h"
#include "sim/record/peaks.h"
#include "sim/record/recorder.h"
#include "sim/record/tunnelling.h"
#include "sim/record/unrest.h"
#include "sim/solve/ode_messages.h"

namespace carom {

namespace {

/// Up to here doubles count every step.
constexpr double kMostSteps = 9007199254740992.0;  // 2^53

/// Steps between two looks at the stop token: about a millisecond with few balls.
constexpr std::int64_t kStepsPerLook = 1024;

/// A duration that is a whole number of steps but for rounding takes just that number.
constexpr double kStepSlack = 1e-9;

std::int64_t step_count(double duration, double step) {
    const double steps = std::ceil(duration / step - kStepSlack);
    if (!(steps <= kMostSteps))
        throw Failure(FailureKind::kRun,
                      fmt::format("method fixed cannot take {:.3g} steps of {} s for {} s: raise "
                                  "simulation.step or shorten the duration",
                                  steps, step, duration));
    return static_cast<std::int64_t>(steps);
}

double largest_speed(const Scene& scene) {
    double speed = 0;
    for (const Ball& ball : scene.balls)
        speed = std::max(speed, ball.velocity.norm() + ball.radius * ball.spin.norm());
    return speed;
}

/// Position correction at most as fast as gravity undoes it in the next step. Without this limit it
/// would add energy: an overlap d leaves at erp d / h, after an inelastic impact at v as fast as
/// v / 5, and nothing takes that speed back.
StepContactRules contact_rules(const Simulation& s) {
    StepContactRules rules;
    rules.step = s.step;
    rules.gravity = s.gravity;
    rules.iterations = s.solver == Solver::kQuick ? std::max(s.iterations, 1) : 0;
    rules.impact_threshold = 2 * s.gravity.norm() * s.step;  // the format of events says so
    rules.correction_speed = s.gravity.norm() * s.step;
    return rules;
}

/// One run: the world and everything that is kept while it is stepped.
class FixedRun {
  public:
    explicit FixedRun(const Scene& scene);

    /// The step that starts at time().
    void step();
    double time() const { return static_cast<double>(steps_) * scene_.simulation.step; }
    bool all_at_rest() const { return log_.all_at_rest(); }
    /// An impact gives an event and a piece.
    void require_room(double end) const {
        carom::require_room(2 * static_cast<std::size_t>(log_.impacts()), time(), end);
    }
    SimulationResult finish(double duration);

  private:
    void solve();
    void add_air();
    void read_state();
    void record();
    void resist_rolling();
    void watch_for_tunnelling();
    Effect tunnelling() const;
    [[noreturn]] void fail(const std::string& text) const;

    const Scene& scene_;
    PairTable pairs_;
    OdeWorld world_;
    ContactSolver solver_;
    EventLog log_;
    std::vector<Recorder> recorders_;
    std::int64_t steps_ = 0;

    /// The first time that a ball went farther in a step than its radius.
    struct TooFar {
        double time;
        std::size_t ball;
        double way;  ///< m
    };
    std::optional<TooFar> too_far_;
    std::vector<AirForce> air_;  ///< per ball; empty where the scene has none

    // The balls before and after the step, and what touched.
    std::vector<Vec3> position_before_, position_;
    std::vector<Velocities> before_, after_;
    std::vector<Contact> contacts_;
    std::vector<char> touching_, impact_;  ///< per ball
};

FixedRun::FixedRun(const Scene& scene)
    : scene_(scene),
      pairs_(scene),
      world_(scene),
      solver_(world_, contact_rules(scene.simulation)),
      log_(EventRules::for_steps(scene.simulation.step, scene.simulation.gravity.norm(),
                                 largest_speed(scene)),
           world_.ball_count()) {
    const std::size_t balls = scene.balls.size();
    for (const Ball& ball : scene.balls)
        recorders_.emplace_back(ball.radius, scene.simulation.gravity);
    if (scene.air)
        for (const Ball& ball : scene.balls) air_.emplace_back(*scene.air, ball);
    position_.resize(balls);
    after_.resize(balls);
    touching_.resize(balls);
    impact_.resize(balls);
    read_state();
    // QuickStep shuffles its rows with ODE's own random numbers, which go on from run to run (and
    // are one sequence for the process: `quick` repeats itself only if runs do not overlap).
    dRandSetSeed(0);
}

void FixedRun::fail(const std::string& text) const {
    const bool exact_solver = scene_.simulation.solver == Solver::kWorld;
    throw Failure(FailureKind::kRun,
                  fmt::format("ODE failed at t = {} s: {}; a smaller simulation.step{} may help",
                              time(), text, exact_solver ? " or simulation.solver: quick" : ""));
}

void FixedRun::step() {
    position_before_ = position_;
    before_ = after_;
    solve();
    read_state();
    solver_.finish(contacts_, after_);
    log_.add_step(time(), contacts_, after_);
    record();
    resist_rolling();
    if (!too_far_) watch_for_tunnelling();
    ++steps_;
}

void FixedRun::solve() {
    const OdeMessages messages;
    try {
        find_contacts(world_, pairs_, contacts_);
        solver_.add_joints(contacts_, before_);
        add_air();
        solver_.step();
    } catch (const OdeFatal& error) {
        fail(error.what());
    }
    if (!messages.empty()) fail(messages.text());
}

/// What rolling resistance and pivoting take from the velocities that the step has led to, for the
/// next one to begin with. Impacts are too short for them.
void FixedRun::resist_rolling() {
    const auto resisted = [this](int ball) {
        const auto b = static_cast<std::size_t>(ball);
        const Ball& scene_ball = scene_.balls[b];
        const double r = scene_ball.radius;
        return ResistedBall{&after_[b], r, scene_ball.mass,
                            scene_ball.inertia_factor * scene_ball.mass * r * r};
    };
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
        const Contact& c = contacts_[i];
        if (c.impact || !is_resisted(c)) continue;
        const bool on_surface = c.other.is_surface;
        const ResistedBall other = on_surface ? ResistedBall{} : resisted(c.other.index);
        resist(c, {c.impulse, tangential_part(solver_.push(i), c.normal)}, resisted(c.ball),
               on_surface ? nullptr : &other);
        for (const int ball : {c.ball, on_surface ? c.ball : c.other.index}) {
            const Velocities& v = after_[static_cast<std::size_t>(ball)];
            world_.set_velocities(ball, v.linear, v.spin);
        }
    }
}

/// As the air is at the step's start.
void FixedRun::add_air() {
    for (std::size_t b = 0; b < air_.size(); ++b) {
        const Velocities& v = before_[b];
        world_.accelerate(static_cast<int>(b),
                          air_[b].acceleration(v.linear, v.spin) -
                              air_[b].buoyant_part() * scene_.simulation.gravity,
                          -air_[b].spin_decay() * v.spin);
    }
}

void FixedRun::read_state() {
    for (int i = 0; i < world_.ball_count(); ++i) {
        const auto b = static_cast<std::size_t>(i);
        position_[b] = world_.position(i);
        after_[b] = {world_.velocity(i), world_.spin(i)};
        if (position_[b].allFinite() && after_[b].linear.allFinite() && after_[b].spin.allFinite())
            continue;
        throw Failure(FailureKind::kRun,
                      fmt::format("the state of ball '{}' is not finite after the step at t = {} s",
                                  scene_.balls[b].name, time()));
    }
}

void FixedRun::watch_for_tunnelling() {
    for (std::size_t b = 0; b < position_.size(); ++b) {
        const double way = after_[b].linear.norm() * scene_.simulation.step;
        if (way <= scene_.balls[b].radius) continue;
        too_far_ = TooFar{time(), b, way};
        return;
    }
}

Effect FixedRun::tunnelling() const {
    if (!too_far_) return {false, "no ball went farther in a step than its radius"};
    const Ball& ball = scene_.balls[too_far_->ball];
    return {
        true,
        fmt::format("at {:.6g} s the ball '{}' goes {:.3g} m in one step, more than its radius of "
                    "{:.3g} m: it may pass through others unnoticed; lower simulation.step below "
                    "{:.3g} s, or take the method exact",
                    too_far_->time, ball.name, too_far_->way, ball.radius,
                    scene_.simulation.step * ball.radius / too_far_->way)};
}

void FixedRun::record() {
    // In air no flight is free.
    std::fill(touching_.begin(), touching_.end(), air_.empty() ? 0 : 1);
    std::fill(impact_.begin(), impact_.end(), 0);
    const auto mark = [this](int ball, bool impact) {
        touching_[static_cast<std::size_t>(ball)] = 1;
        if (impact) impact_[static_cast<std::size_t>(ball)] = 1;
    };
    for (const Contact& contact : contacts_) {
        mark(contact.ball, contact.impact);
        if (!contact.other.is_surface) mark(contact.other.index, contact.impact);
    }

    Step step;
    step.start = time();
    step.end = static_cast<double>(steps_ + 1) * scene_.simulation.step;
    for (std::size_t b = 0; b < recorders_.size(); ++b) {
        step.position = position_before_[b];
        step.end_position = position_[b];
        step.before = before_[b];
        step.mean = after_[b];
        step.touching = touching_[b] != 0;
        step.impact = impact_[b] != 0;
        recorders_[b].add(step);
    }
}

SimulationResult FixedRun::finish(double duration) {
    SimulationResult result;
    Motion& motion = result.motion;
    motion.duration = duration;
    for (const Ball& ball : scene_.balls) motion.ball_names.push_back(ball.name);
    for (const Surface& surface : scene_.surfaces) motion.surface_names.push_back(surface.name);
    for (Recorder& recorder : recorders_) motion.balls.push_back(recorder.finish());
    motion.events = log_.finish();
    motion.peaks = find_peaks(scene_, motion);

    result.report.steps = steps_;
    result.report.impacts = log_.impacts();
    result.report.effects = effects_of(scene_, pairs_);
    result.report.effects[kTunnelling] = tunnelling();
    return result;
}

/// What moves at the end.
std::string unrest(const Scene& scene, const Motion& motion) {
    const Simulation& settings = scene.simulation;
    const double rest_speed =
        EventRules::for_steps(settings.step, settings.gravity.norm(), largest_speed(scene))
            .rest_speed;
    std::vector<UnrestedBall> moving;
    for (std::size_t b = 0; b < scene.balls.size(); ++b) {
        const BallState s = motion.balls[b].at(motion.duration);
        const double speed = s.velocity.norm(), slip = scene.balls[b].radius * s.spin.norm();
        if (speed > rest_speed || slip > rest_speed)
            moving.push_back({scene.balls[b].name, "moves", speed, slip});
    }
    return unrest_text(moving, motion.duration);
}

}  // namespace

SimulationResult simulate_fixed(const Scene& scene, const std::stop_token& stop,
                                const SimulationProgress& progress) {
    const Simulation& settings = scene.simulation;
    const bool until_rest = !settings.duration && !settings.gravity.isZero(0);
    const double limit = settings.duration.value_or(settings.max_duration);
    // At least one step, so that a motion of 0 s has a state.
    const std::int64_t count = std::max<std::int64_t>(step_count(limit, settings.step), 1);

    FixedRun run(scene);
    for (std::int64_t n = 0; n < count; ++n) {
        if (n % kStepsPerLook == 0) {
            if (stop.stop_requested())
                throw Failure(FailureKind::kRun,
                              fmt::format("interrupted at t = {} s of the simulation", run.time()));
            run.require_room(limit);
            if (progress) progress(run.time());
        }
        run.step();
        if (until_rest && run.all_at_rest()) return run.finish(std::min(run.time(), limit));
    }
    SimulationResult result = run.finish(limit);
    if (!settings.duration) result.report.unrest = unrest(scene, result.motion);
    return result;
}

}  // namespace carom
