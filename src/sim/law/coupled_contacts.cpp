#include "sim/law/coupled_contacts.h"

#include <algorithm>

namespace carom {

double CoupledContacts::smallest_radius() const {
    double radius = balls[0].radius;
    for (std::size_t i = 1; i < ball_count; ++i) radius = std::min(radius, balls[i].radius);
    return radius;
}

bool CoupledContacts::in_air() const {
    return std::any_of(balls.begin(), balls.begin() + ball_count,
                       [](const CoupledBall& b) { return b.air != nullptr; });
}

double CoupledContacts::weight_at(const CoupledContact& c) const {
    double mass = balls[static_cast<std::size_t>(c.ball)].mass;
    if (c.other >= 0) mass = std::min(mass, balls[static_cast<std::size_t>(c.other)].mass);
    return mass * gravity.norm();
}

}  // namespace carom
