#include "sim/record/event_log.h"

#include <algorithm>

namespace carom {

namespace {

/// Rounding of speeds that should be 0, relative to the scene's speeds. Contacts that share an
/// island leave a slip of kIslandCfm times their force.
constexpr double kSpeedFloor = 1e-9;

}  // namespace

EventRules EventRules::for_steps(double step, double gravity, double speed) {
    const double floor = kSpeedFloor * speed;
    const double fall = gravity * step;
    EventRules rules;
    rules.lasting_speed = 2 * fall + floor;  // as the contract has it: above this it is an impact
    rules.rest_speed = 0.01 * fall + floor;
    rules.slip_speed = 0.001 * fall + floor;
    return rules;
}

EventLog::EventLog(const EventRules& rules, int balls) : rules_(rules), balls_(balls) {}

void EventLog::add_step(double time, const std::vector<Contact>& contacts,
                        const std::vector<Velocities>& after) {
    for (auto& [key, pair] : pairs_) pair.seen = false;
    for (const Contact& contact : contacts) {
        if (contact.impact)
            add_impact(time, contact);
        else if (lasting(contact))
            watch(time, contact, after);
    }
    drop_departed(time);
    first_step_ = false;
}

bool EventLog::lasting(const Contact& contact) const {
    return contact.separation_speed <= rules_.lasting_speed;
}

EventKind EventLog::kind_of(const Contact& contact, const std::vector<Velocities>& after) const {
    const Vec3& n = contact.normal;
    const auto along_surface = [&](int ball) {
        const Vec3& v = after[static_cast<std::size_t>(ball)].linear;
        return (v - v.dot(n) * n).norm();
    };
    double speed = along_surface(contact.ball);
    if (!contact.other.is_surface) speed = std::max(speed, along_surface(contact.other.index));
    const bool moves = speed > rules_.rest_speed;
    const bool slips = contact.slip_after.norm() > rules_.slip_speed;
    if (contact.friction == 0) return moves ? EventKind::kSlide : EventKind::kRest;
    if (slips) return EventKind::kSlide;
    return moves ? EventKind::kRoll : EventKind::kRest;
}

void EventLog::add_row(double time, EventKind kind, const Contact& contact) {
    events_.push_back(event_at(contact, kind, time));
}

void EventLog::add_impact(double time, const Contact& contact) {
    const Key key{contact.ball, {!contact.other.is_surface, contact.other.index}};
    if (const auto it = pairs_.find(key); it != pairs_.end()) {
        Pair& pair = it->second;
        if (pair.kind.is_stated() && pair.gone_steps > 0)
            add_row(pair.gone_time, EventKind::kLeave, pair.last);
        pairs_.erase(it);
    }
    add_row(time, EventKind::kImpact, contact);
    Event& event = events_.back();
    event.approach_speed = contact.approach_speed;
    event.separation_speed = std::max(contact.separation_speed, 0.0);
    event.restitution = contact.restitution;
    event.impulse = contact.impulse;
    event.tangential_impulse = contact.tangential_impulse;
    ++impacts_;
}

void EventLog::watch(double time, const Contact& contact, const std::vector<Velocities>& after) {
    const Key key{contact.ball, {!contact.other.is_surface, contact.other.index}};
    const auto [it, is_new] = pairs_.try_emplace(key);
    Pair& pair = it->second;
    if (is_new && first_step_) pair.kind.begins_at_start();
    pair.last = contact;
    pair.seen = true;
    pair.gone_steps = 0;

    const EventKind kind = kind_of(contact, after);
    // A rest counts from where the ball stopped, but is not stated while position correction still
    // lifts it: that is no motion, but its end is awaited.
    if (kind == EventKind::kRest && contact.separation_speed > rules_.rest_speed)
        return pair.kind.see(kind, time);
    const int steps = kind == EventKind::kRest ? kRestSteps : kKindSteps;
    if (!pair.kind.persists(kind, time, steps)) return;
    const double since = pair.kind.since();
    if (pair.kind.state(kind)) add_row(since, kind, contact);
}

void EventLog::drop_departed(double time) {
    for (auto it = pairs_.begin(); it != pairs_.end();) {
        Pair& pair = it->second;
        if (pair.seen) {
            ++it;
            continue;
        }
        if (pair.gone_steps++ == 0) pair.gone_time = time;
        if (pair.gone_steps < kLeaveSteps) {
            ++it;
            continue;
        }
        // Also what touched at time 0 and left before its kind was sure.
        if (pair.kind.is_stated() || pair.kind.from_start())
            add_row(pair.gone_time, EventKind::kLeave, pair.last);
        it = pairs_.erase(it);
    }
}

bool EventLog::all_at_rest() const {
    std::vector<bool> rests(static_cast<std::size_t>(balls_), false);
    for (const auto& [key, pair] : pairs_) {
        if (pair.kind.stated() != EventKind::kRest || pair.kind.wavers() || !pair.seen)
            return false;
        rests[static_cast<std::size_t>(pair.last.ball)] = true;
        if (!pair.last.other.is_surface)
            rests[static_cast<std::size_t>(pair.last.other.index)] = true;
    }
    return std::all_of(rests.begin(), rests.end(), [](bool b) { return b; });
}

std::vector<Event> EventLog::finish() {
    // Kinds are stated some steps after they began.
    std::stable_sort(events_.begin(), events_.end(),
                     [](const Event& a, const Event& b) { return a.time < b.time; });
    return std::move(events_);
}

}  // namespace carom
