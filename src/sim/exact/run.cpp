#include "sim/exact/run.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/failure.h"
#include "sim/exact/cells.h"
#include "sim/exact/refusal.h"
#include "sim/exact/standstill.h"
#include "sim/record/kept_limit.h"
#include "sim/record/model_features.h"
#include "sim/record/peaks.h"

namespace carom {

namespace {

/// Events at one instant, up to this many roundings of the time, belong together.
constexpr double kTogether = 4 * std::numeric_limits<double>::epsilon();

/// Events between two looks at the stop token, where nothing is stepped or integrated, which takes
/// a hundred times as long.
constexpr std::int64_t kEventsPerLook = 1024;

/// Who is near whom is looked at again after so many events a ball.
constexpr std::int64_t kEventsPerFit = 16;
/// The first time sooner: nothing is known at the start.
constexpr std::int64_t kEventsToFirstFit = 2;

/// Impacts for each ball that leaves its place, above which lists are as fast as cells and below
/// which they are not any more. Measured on gases (bench/gas.cpp): both at a packing of 0.15.
constexpr double kDense = 1.2, kStaysDense = 0.6;

}  // namespace

// ---- Start and end
// --------------------------------------------------------------------------------

ExactRun::ExactRun(const Scene& scene, double end, const ExactOptions& options)
    : world_(scene),
      end_(end),
      tap_(options.tap),
      links_(scene.balls.size()),
      queue_(scene.balls.size()),
      next_(scene.balls.size()),
      can_collide_(can_collide(scene, world_.pairs, end)) {
    world_.place_rounding = options.place_rounding;
    if (world_.bounded_surfaces.size() >= options.surfaces_for_tree) world_.build_surface_tree();
    const int balls = static_cast<int>(scene.balls.size());
    for (int i = 0; i < balls; ++i) aftermath_.start(i);
    world_.balls_can_meet = can_collide_.possible;
    if (can_collide_.possible && scene.balls.size() >= options.balls_for_grid)
        world_.find_neighbours(0, false);
    for (int i = 0; i < balls; ++i) predict(i, 0);
}

SimulationResult ExactRun::finish() {
    const Scene& scene = world_.scene;
    Motion motion;
    motion.duration = end_;
    for (const Ball& b : scene.balls) motion.ball_names.push_back(b.name);
    for (const Surface& s : scene.surfaces) motion.surface_names.push_back(s.name);
    motion.balls.resize(scene.balls.size());
    if (tap_) {
        tap_(world_.log, log_.kept_events(), std::numeric_limits<double>::infinity());
    } else {
        motion.events = log_.take_events();
        world_.log.move_into(motion.balls);
        motion.peaks = find_peaks(scene, motion);
    }
    SimulationReport& report = log_.report;
    report.effects = effects_of(scene, world_.pairs);
    report.effects["pairs"] = {can_collide_.possible, can_collide_.why};
    add_contact_effects(report, impacts_.is_in_free_space());
    return {std::move(motion), std::move(report)};
}

// ---- Loop
// -----------------------------------------------------------------------------------------

void ExactRun::run(const std::stop_token& stop, const SimulationProgress& progress,
                   bool until_rest) {
    Standstill standstill;
    std::int64_t looked = 0;  // how much that takes long had been done
    std::int64_t tapped = 0;  // events
    const auto balls = static_cast<std::int64_t>(world_.balls.size());
    for (std::int64_t events = 0;; ++events) {
        const EventQueue::Entry first = queue_.first();
        const bool step = piles_.next_step() <= first.time;
        if (std::min(piles_.next_step(), first.time) > end_) {
            if (until_rest) log_.report.unrest = rest_.unrest(end_);
            break;
        }
        Prediction next;
        if (step) {
            next.time = piles_.next_step();
            next.ball = piles_.awake().empty() ? 0 : piles_.awake().front();
        } else {
            next = due(first.ball);
            queue_.take_first();
            fetch_upcoming();
            if (!is_current(next)) continue;
        }
        const bool stuck = standstill.stuck(next.time, next.ball);
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
        fit_places(next.time);
        if (until_rest && rest_.all_at_rest()) {
            end_ = next.time;
            break;
        }
        const std::int64_t slow = log_.report.steps + log_.report.integrated + (step ? events : 0);
        if (slow == looked && events % kEventsPerLook != 0) continue;
        const bool has_stepped = slow != looked;
        looked = slow;
        report_progress(stop, progress, next.time);
        // To take pieces costs something for each ball.
        if (!tap_ || (!has_stepped && events - tapped < balls)) continue;
        tapped = events;
        tap_(world_.log, log_.kept_events(), next.time);
    }
}

void ExactRun::report_progress(const std::stop_token& stop, const SimulationProgress& progress,
                               double now) const {
    const auto pieces = static_cast<std::size_t>(log_.report.impacts + log_.report.integrated);
    require_room(log_.events().size() + (tap_ ? 0 : pieces), now, end_);
    if (stop.stop_requested())
        throw Failure(FailureKind::kRun, fmt::format("interrupted at {} s of motion", now));
    if (progress) progress(now);
}

void ExactRun::process_instant(double now) {
    impacts_.begin_instant();
    stepped_.clear();
    for (std::size_t i = 0; i < together_.size(); ++i) {
        const Prediction p = together_[i];
        if (is_current(p)) collect(p, now);
    }
    // Clusters that do not touch are resolved one by one.
    const std::size_t met = impacts_.connect(now);
    for (std::size_t i = 0; i < met; ++i) {
        if (!impacts_.resolve(i, now)) continue;
        const bool lossy = impacts_.is_lossy();
        for (const int ball : impacts_.balls()) {
            if (lossy) piles_.note_impact(ball, now);
            predict(ball, now);
        }
    }
    if (!stepped_.empty()) step_islands(now);
}

/// What is due for one ball happens, unless others have a part in it: that is collected.
void ExactRun::collect(const Prediction& p, double now) {
    const ExactBall& b = world_.ball(p.ball);
    const ExactBall* partner = p.partner.is_surface ? nullptr : &world_.ball(p.partner.index);
    if (p.kind == PredictionKind::kCell) {
        change_cell(p.ball, now);
    } else if (p.kind == PredictionKind::kPhase && b.phase() == Phase::kIsland) {
        stepped_.push_back(p.ball);
    } else if (p.kind == PredictionKind::kPhase) {
        if (const auto velocities = held_.end_phase(p.ball, now))
            islands_.enter(p.ball, now, *velocities);
        predict(p.ball, now);
    } else if (partner != nullptr && partner->stamp != p.partner_stamp) {
        predict(p.ball, now);  // the partner has moved on since
    } else if (partner != nullptr && (in_pile(b.phase()) || in_pile(partner->phase()))) {
        piles_.join(in_pile(b.phase()) ? p.partner.index : p.ball, now);
    } else {
        if (partner != nullptr) held_.put_on_surface(p.partner.index, now);
        impacts_.add(held_.meet(p.ball, p.partner, p.seconds, now));
    }
}

void ExactRun::step_islands(double now) {
    const Islands::Stepped stepped = islands_.step(stepped_, now);
    for (const int ball : stepped.into_pile) piles_.join(ball, now);
    for (const int ball : stepped.balls) predict(ball, now);
}

void ExactRun::step_pile(double now) {
    piles_.step(now);
    const std::vector<int> awake = piles_.awake();
    for (const int ball : awake)
        if (piles_.leave(ball, now)) predict(ball, now);
    piles_.end_step();
}

/// Events of a ball that have no end in time: it is stepped, as is what it meets.
void ExactRun::give_up_on(const Prediction& p) {
    for (const int ball : {p.ball, p.partner.is_surface ? -1 : p.partner.index}) {
        if (ball < 0 || in_pile(world_.ball(ball).phase())) continue;
        islands_.enter(ball, p.time, held_.give_up(ball, p.time));
        predict(ball, p.time);
    }
}

// ---- Queue
// ----------------------------------------------------------------------------------------

/// What the ball's entry in the list of events stands for.
Prediction ExactRun::due(int ball) const {
    Prediction p = next_[static_cast<std::size_t>(ball)];
    if (p.leaves_cell < p.time) {
        p.time = p.leaves_cell;
        p.kind = PredictionKind::kCell;
    }
    return p;
}

/// Has what an event reads first on its way.
void ExactRun::fetch(int ball) const {
    if (!world_.finds_neighbours() || ball < 0) return;
    __builtin_prefetch(&next_[static_cast<std::size_t>(ball)]);
    world_.fetch(ball);
    if (world_.grid) world_.grid->fetch(ball);
}

/// What the next event reads, and the little that a few of those after it read first: more would
/// wait for each other.
void ExactRun::fetch_upcoming() const {
    fetch(queue_.upcoming().ball);
    queue_.for_some_upcoming(
        [this](int ball) { __builtin_prefetch(&next_[static_cast<std::size_t>(ball)]); });
}

/// The next prediction, and the others of its instant.
void ExactRun::take_together(const Prediction& next) {
    together_.assign(1, next);
    while (queue_.upcoming().time <= next.time * (1 + kTogether)) {
        const int ball = queue_.first().ball;
        const Prediction p = due(ball);
        if (is_current(p)) together_.push_back(p);
        queue_.drop(ball);
    }
}

void ExactRun::predict(int ball, double now) {
    if (world_.ball(ball).phase() == Phase::kPile) return;
    world_.follow(ball, now);
    act_on(predictor_.look_ahead(ball, now), now);
}

/// Takes a ball's outlook over. What touches and goes on to do so joins an island at once.
void ExactRun::act_on(const Outlook& outlook, double now) {
    const int ball = outlook.next.ball;
    for (const Contact& c : outlook.pressed_again) notes_.note_press(c, now);
    Prediction& next = next_[static_cast<std::size_t>(ball)];
    next = outlook.next;
    if (next.kind == PredictionKind::kPresses) {
        if (const auto& pressing = outlook.pressing)
            notes_.note_landing(pressing->contact, now, pressing->event_due);
        islands_.enter(ball, now, world_.velocities(ball, now));
        next = {};
        next.time = now;
        next.ball = ball;
        next.stamp = world_.ball(ball).stamp;
    }
    next.leaves_cell = leaves_cell(world_, ball, now, std::min(next.time, end_));
    const double time = std::min(next.time, next.leaves_cell);
    if (time <= end_)
        queue_.put(ball, time);
    else
        queue_.drop(ball);
}

/// A ball has left its cell: only the cells that come into reach have to be looked at.
void ExactRun::change_cell(int ball, double now) {
    ++changes_since_fit_;
    const CellChange change = enter_cell(world_, ball, now);
    Outlook outlook;
    outlook.next = next_[static_cast<std::size_t>(ball)];
    const auto look = [&](int other) { predictor_.look_at_ball(outlook, other, now); };
    if (world_.lists)
        for (const int other : world_.lists->added()) look(other);
    else if (change.axes == 1 && std::abs(change.side) == 1)
        world_.for_each_in_layer(ball, change.axis, change.side, look);
    else if (change.axes > 0)
        world_.for_each_near(ball, look);
    act_on(outlook, now);
}

/// Where balls have spread or gathered, their places follow.
void ExactRun::fit_places(double now) {
    const auto balls = static_cast<std::int64_t>(world_.balls.size());
    const std::int64_t wait = fitted_ ? kEventsPerFit : kEventsToFirstFit;
    if (!world_.finds_neighbours() || ++events_since_fit_ < wait * balls) return;
    fitted_ = true;
    const bool by_lists = is_dense();
    events_since_fit_ = changes_since_fit_ = 0;
    impacts_at_fit_ = log_.report.impacts;
    if (!world_.refit_neighbours(now, by_lists)) return;
    for (int i = 0; i < static_cast<int>(balls); ++i) predict(i, now);
}

/// Whether balls hit each other so much more often than they leave their places that lists are
/// better than cells, since the last fit. Only where nothing presses them together: what is stepped
/// (its motion depends on when it is looked at) is looked for in cells.
bool ExactRun::is_dense() const {
    const auto impacts = static_cast<double>(log_.report.impacts - impacts_at_fit_);
    const auto changes = static_cast<double>(changes_since_fit_);
    return impacts_.is_in_free_space() && impacts > (world_.lists ? kStaysDense : kDense) * changes;
}

}  // namespace carom
