// One ball on one flat surface (a plane, or a face of a box) that stays in contact: it rests,
// slides or rolls, in closed form as long as the slip keeps its direction.
#pragma once

#include <limits>
#include <optional>

#include "motion/motion.h"
#include "sim/contact/contact.h"

namespace carom {

struct FlatContact {
    Vec3 normal = Vec3::UnitZ();  ///< unit, towards the ball
    double radius = 0.1;          ///< of the ball, m
    double inertia_factor = 0.4;  ///< k of I = k m r^2
    double friction = 0;          ///< Coulomb's mu
    Vec3 gravity = Vec3::Zero();  ///< m/s^2; -g . n > 0, it presses the two together
    double rolling = 0;           ///< a ball that rolls slows by this times N/m
    double pivoting = 0;          ///< moment against spin about the normal over N, m
};

/// The motion from now on: constant accelerations for `seconds`, then look again.
struct FlatMotion {
    EventKind kind = EventKind::kSlide;  ///< kSlide, kRoll or kRest
    Velocities velocities;               ///< now, made exact: none along n, no slip when rolling
    Vec3 acceleration = Vec3::Zero();
    Vec3 spin_rate = Vec3::Zero();
    double seconds = std::numeric_limits<double>::infinity();
};

/// Empty when the slip turns (sliding across a slope), or a roll that is resisted: there is no
/// closed form then.
///
/// With F the friction force on the ball at the contact, arm -R n: m dv/dt = m g_t + F,
/// k m R^2 dw/dt = -R n x F, so the slip s = v - R w x n changes by
///   ds/dt = g_t + (1 + 1/k) F / m.
/// Sliding: F = -mu m g_n s/|s|. Rolling keeps s = 0: F = -m g_t k/(1+k), which Coulomb allows up
/// to mu m g_n. (E. J. Routh, Dynamics of a System of Rigid Bodies, Advanced Part, 1905, ch. IV-V.)
///
/// Rolling resistance takes r = mu_r g_n off a roll, against v: a = g_t/(1+k) - r v/|v|, by the
/// moment (1+k) r m R, so that s stays 0; friction then is F = -m (g_t k/(1+k) + r v/|v|), and r at
/// most what Coulomb leaves of it. It holds a ball that stands while g_t/(1+k) <= r, and does not
/// act on one that slides, as for billiard balls. Pivoting takes p g_n / (k R^2) off the spin about
/// n, whatever else the ball does.
std::optional<FlatMotion> flat_motion(const FlatContact& contact, const Velocities& now,
                                      double slip_tolerance);

/// The velocities along the surface with which a lasting contact begins where the bounces that are
/// left of a series are summed. `now` is the state between two impacts, with the speed `separation`
/// [m/s] along the normal; negative: it approaches, and no impact has been.
///
/// The tail's T seconds of contact press with m g_n T, its impacts with m (g_n T - separation) in
/// all, whatever the coefficient: friction would act on m separation too much. It is given back, as
/// if the last impact had been without rebound. So the normal force has the same sum and the same
/// mean time as that of the impacts, and velocities, spin and place at the tail's end are theirs.
Velocities without_bounces(const FlatContact& contact, const Velocities& now, double separation,
                           double slip_tolerance);

}  // namespace carom
