#include "sim/exact/aftermath.h"

#include <algorithm>
#include <cmath>

#include "sim/world/seams.h"

namespace carom {

void Aftermath::start(int ball) {
    std::vector<Contact> contacts;
    const Ball& body = world_.body(ball);
    const Velocities start{body.velocity, body.spin};
    world_.for_each_surface_near(ball, body.position, world_.reach(ball), [&](int s) {
        Contact c = world_.contact_at(ball, {true, s}, 0);
        if (-c.depth > world_.touch_tolerance(body.position, c.point, body.radius)) return;
        c.separation_speed = relative_velocity(c, start, {}).dot(c.normal);
        contacts.push_back(c);
    });
    merge_places(world_, body.position, start, contacts, 0, [](const Contact&, const Contact&) {});
    if (rules_.approaches_at_start(ball, contacts))
        forms_.begin_flight(ball, 0, start);  // into an impact at once
    else
        settle_ball(ball, 0, start, contacts, {}, {body.velocity.norm(), true});
}

void Aftermath::settle(const ImpactCluster& cluster, double first_approach,
                       const std::vector<Contact>& impacts, double now) {
    const bool stepped = islands_.has_part_in(cluster);
    // What was left to a step has to be linked for it.
    const bool coarse = std::any_of(cluster.balls().begin(), cluster.balls().end(),
                                    [this](int ball) { return world_.ball(ball).coarse; });
    for (const int ball : cluster.balls()) {
        const Velocities& velocities = cluster.body(ball).velocities;
        if (stepped) {
            islands_.enter(ball, now, velocities);
            world_.ball(ball).coarse = coarse;
            continue;
        }
        // What touches at the start, and goes on to do so, is no news; nor is it if it bounced
        // first.
        const bool at_start = now == 0 && world_.ball(ball).surface < 0;
        cluster.contacts_of(ball, contacts_);
        settle_ball(ball, now, velocities, contacts_, impacts, {first_approach, at_start});
    }
}

/// The separation speed whose friction a contact gives back (without_bounces()): that of its own
/// impact, as far as that one had friction. What another impact has lifted has none; a slip that
/// has sprung back is not the one that friction was against.
double Aftermath::bounce_of(const Contact& c, const std::vector<Contact>& impacts) const {
    const auto hit = std::find_if(impacts.begin(), impacts.end(), [&c](const Contact& impact) {
        return impact.ball == c.ball && impact.other == c.other;
    });
    if (hit == impacts.end() || c.friction == 0 || tangential_restitution(c) != 0) return 0;
    return std::min(c.separation_speed,
                    hit->tangential_impulse / (c.friction * world_.ball(c.ball).mass));
}

void Aftermath::settle_ball(int ball, double now, const Velocities& velocities,
                            const std::vector<Contact>& contacts,
                            const std::vector<Contact>& impacts, const Scale& scale) {
    const Contact* lasting = nullptr;
    double bounce_time_left = 0;
    bool many = false;
    for (const Contact& c : contacts) {
        double bounce_time = 0;
        if (!rules_.lasts(c, ball, now, velocities.linear, scale.speed, bounce_time)) continue;
        if (lasting != nullptr) many = true;
        if (many) notes_.note_landing(*lasting, now, now + bounce_time_left);
        lasting = &c;
        bounce_time_left = bounce_time;
    }
    if (many) {
        notes_.note_landing(*lasting, now, now + bounce_time_left);
        islands_.enter(ball, now, velocities);
        return;
    }
    if (lasting != nullptr) {
        const double v = scale.at_start ? lasting->separation_speed : bounce_of(*lasting, impacts);
        const bool bounces = std::abs(v) > kStillFraction * scale.speed;
        const Velocities along =
            bounces ? forms_.landed(ball, now, *lasting, velocities, v) : velocities;
        if (const auto stepped =
                held_.begin(ball, now, *lasting, along, {bounce_time_left, scale.at_start}))
            islands_.enter(ball, now, *stepped);
        return;
    }
    if (world_.ball(ball).surface >= 0) log_.add_of_held(EventKind::kLeave, ball, now);
    forms_.begin_flight(ball, now, velocities);
}

}  // namespace carom
