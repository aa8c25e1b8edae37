#include <carom/motion.h>
#include <fmt/format.h>

#include "api/inner.h"
#include "sim/simulate.h"

namespace carom::v1 {

namespace {

State plain(const BallState& state) {
    const Quat& q = state.orientation;
    return {v1::plain(state.position),
            {q.w(), q.x(), q.y(), q.z()},
            v1::plain(state.velocity),
            v1::plain(state.spin)};
}

EventKind plain(carom::EventKind kind) {
    switch (kind) {
        case carom::EventKind::kImpact:
            return EventKind::impact;
        case carom::EventKind::kSlide:
            return EventKind::slide;
        case carom::EventKind::kRoll:
            return EventKind::roll;
        case carom::EventKind::kRest:
            return EventKind::rest;
        case carom::EventKind::kLeave:
            break;
    }
    return EventKind::leave;
}

void require_time(const carom::Motion& motion, double time) {
    if (!(time >= 0 && time <= motion.duration))
        throw Error(
            fmt::format("no instant {} s: the motion lasts from 0 to {} s", time, motion.duration));
}

const Trajectory& trajectory(const carom::Motion& motion, std::size_t ball) {
    if (ball >= motion.balls.size())
        throw Error(
            fmt::format("there is no ball {}: the motion has {}", ball, motion.balls.size()));
    return motion.balls[ball];
}

}  // namespace

const char* name(EventKind kind) {
    switch (kind) {
        case EventKind::impact:
            return "impact";
        case EventKind::slide:
            return "slide";
        case EventKind::roll:
            return "roll";
        case EventKind::rest:
            return "rest";
        case EventKind::leave:
            break;
    }
    return "leave";
}

void require_instant(const Motion& motion, double time) {
    require_time(motion.impl().motion, time);
}

Motion::Motion(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

double Motion::duration() const { return impl_->motion.duration; }
std::vector<std::string> Motion::balls() const { return impl_->motion.ball_names; }
std::vector<std::string> Motion::surfaces() const { return impl_->motion.surface_names; }
std::uint64_t Motion::hash() const { return impl_->motion.hash(); }

State Motion::state(std::size_t ball, double time) const {
    require_time(impl_->motion, time);
    return plain(trajectory(impl_->motion, ball).at(time));
}

std::vector<State> Motion::states(const std::vector<double>& times) const {
    const carom::Motion& motion = impl_->motion;
    std::vector<State> result;
    result.reserve(times.size() * motion.balls.size());
    for (const double time : times) {
        require_time(motion, time);
        for (const Trajectory& ball : motion.balls) result.push_back(plain(ball.at(time)));
    }
    return result;
}

std::vector<Event> Motion::events() const {
    std::vector<Event> result;
    for (const carom::Event& e : impl_->motion.events)
        result.push_back({e.time, e.ball, e.other.index, e.other.is_surface, plain(e.kind),
                          v1::plain(e.point), v1::plain(e.normal), e.approach_speed,
                          e.separation_speed, e.restitution, e.impulse, e.tangential_impulse});
    return result;
}

std::vector<Peak> Motion::peaks(std::size_t ball) const {
    trajectory(impl_->motion, ball);
    std::vector<Peak> result;
    for (const carom::Peak& peak : impl_->motion.peaks[ball])
        result.push_back({peak.time, peak.height});
    return result;
}

Motion simulate(const Scene& scene, const Control& control) {
    return translated(control, [&] {
        SimulationResult result =
            carom::simulate(scene.impl().scene, control.stop, control.progress);
        return Motion(std::make_shared<Motion::Impl>(Motion::Impl{std::move(result.motion)}));
    });
}

}  // namespace carom::v1
