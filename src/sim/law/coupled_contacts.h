// A few balls that lasting contacts link with one another and with surfaces: what they are, and
// what acts between them.
#pragma once

#include <array>
#include <cstddef>

#include "sim/law/single_contact.h"

namespace carom {

inline constexpr std::size_t kMostCoupledBalls = 3;
inline constexpr std::size_t kMostCoupledContacts = 6;

/// Which of the balls of a system is met; -1 for a surface.
struct CoupledContact {
    int ball = 0;
    int other = -1;
    /// Of a surface, the feature that is met; of two balls only `distance` counts.
    SingleContact feature;
    double friction = 0;
    ContactMode mode = ContactMode::kSmooth;
    bool presses = true;  ///< false: it is left out
};

/// Of one ball: m, kg, and k of I = k m r^2.
struct CoupledBall {
    double radius = 0.1;
    double mass = 1;
    double inertia_factor = 0.4;
    double buoyant_part = 0;        ///< gravity less this part of it pulls the ball
    const AirForce* air = nullptr;  ///< as in SingleContact
};

struct CoupledContacts {
    std::array<CoupledBall, kMostCoupledBalls> balls;
    std::array<CoupledContact, kMostCoupledContacts> contacts;
    std::size_t ball_count = 0;
    std::size_t contact_count = 0;
    Vec3 gravity = Vec3::Zero();  ///< m/s^2: the size of what acts

    bool in_air() const;  ///< whether moving through air acts on a ball
    /// Gravity less buoyancy, m/s^2.
    Vec3 pull(std::size_t ball) const { return (1 - balls[ball].buoyant_part) * gravity; }

    double smallest_radius() const;
    /// The weight of the lighter ball of a contact [N]: the size of what acts there.
    double weight_at(const CoupledContact& contact) const;
};

using CoupledState = std::array<ContactState, kMostCoupledBalls>;

/// What acts at one contact, on `ball`; on the other ball the opposite.
struct CoupledContactForces {
    Vec3 normal = Vec3::UnitZ();      ///< towards `ball`
    Vec3 normal_rate = Vec3::Zero();  ///< 1/s
    double push = 0;                  ///< along the normal, N
    Vec3 friction = Vec3::Zero();     ///< N
    Vec3 slip = Vec3::Zero();         ///< m/s
    Vec3 slip_rate = Vec3::Zero();    ///< m/s^2
    Vec3 direction = Vec3::Zero();    ///< of an incipient slip; 0 where there is none
    double speed = 0;                 ///< along the normal, m/s: 0 while it lasts
    double departure = 0;  ///< second rate of the gap, m/s^2: what keeps it shut where it presses
};

struct CoupledForces {
    std::array<Vec3, kMostCoupledBalls> acceleration, spin_rate;
    std::array<CoupledContactForces, kMostCoupledContacts> contacts;
};

}  // namespace carom
