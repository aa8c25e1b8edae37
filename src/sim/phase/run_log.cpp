#include "sim/phase/run_log.h"

#include <algorithm>

#include "sim/contact/contact_laws.h"
#include "sim/record/event_log.h"

namespace carom {

namespace {

/// An impact with so much of the friction that sliding has has slid all the way.
constexpr double kSlides = 1 - 1e-9;

}  // namespace

void RunLog::add(EventKind kind, const Contact& contact, double now) {
    events_.push_back(event_at(contact, kind, now));
}

void RunLog::add_of_held(EventKind kind, int ball, double now) {
    const ExactBall& b = world_.ball(ball);
    Event e;
    e.time = now;
    e.ball = ball;
    e.other = {true, b.surface};
    e.kind = kind;
    e.normal = b.normal;
    e.point = world_.state(ball, now).position - world_.ball(ball).radius * b.normal;
    events_.push_back(e);
}

void RunLog::add_impacts(const std::vector<Contact>& impacts, double now) {
    for (const Contact& c : impacts) {
        add(EventKind::kImpact, c, now);
        Event& e = events_.back();
        e.approach_speed = std::max(c.approach_speed, 0.0);
        e.separation_speed = std::max(c.separation_speed, 0.0);
        e.restitution = c.restitution;
        e.impulse = c.impulse;
        e.tangential_impulse = c.tangential_impulse;
        ++report.impacts;
    }
}

bool RunLog::slid_in_impact(const Contact& c, double now) const {
    if (tangential_restitution(c) != 0) return false;
    for (auto e = events_.rbegin(); e != events_.rend() && e->time == now; ++e)
        if (e->kind == EventKind::kImpact && e->ball == c.ball && e->other == c.other)
            return e->tangential_impulse >= kSlides * c.friction * e->impulse;
    return false;
}

}  // namespace carom
