// One ball that stays in contact with one surface where the motion has no closed form: on a sphere,
// a capsule, a rim, an edge or a corner, or with a slip that turns across a slope. Its laws of
// motion.
#pragma once

#include "geometry/feature.h"
#include "sim/contact/contact.h"
#include "sim/law/air_force.h"

namespace carom {

/// Centre, velocity and spin.
struct ContactState {
    Vec3 x = Vec3::Zero();
    Vec3 v = Vec3::Zero();
    Vec3 w = Vec3::Zero();
};

/// The ball's centre keeps its distance from the core of one feature of the surface.
struct SingleContact : Feature {
    double radius = 0.1;            ///< of the ball, m
    double inertia_factor = 0.4;    ///< k of I = k m r^2
    double friction = 0;            ///< Coulomb's mu
    Vec3 gravity = Vec3::Zero();    ///< less buoyancy, m/s^2
    const AirForce* air = nullptr;  ///< what moving through air does to the ball; null for nothing
    double rolling = 0;             ///< as in FlatContact
    double pivoting = 0;
    bool roll_begins = false;  ///< it still goes where gravity pulls: that is resisted
    int pivots = 0;            ///< sign of the spin about the normal; 0 while friction holds it

    /// Gravity and air together, m/s^2.
    Vec3 pull(const ContactState& state) const {
        return air == nullptr ? gravity : Vec3(gravity + air->acceleration(state.v, state.w));
    }
};

/// The contact of a ball at `x` [m] that touches `shape`. On the border of two features the motion
/// `v` [m/s] decides, and gravity where that has no part across the border.
SingleContact single_contact(const SurfaceShape& shape, const Vec3& x, const Vec3& v, double radius,
                             const Vec3& gravity);

/// What acts at the contact.
enum class ContactMode {
    kSmooth,     ///< no friction
    kSliding,    ///< friction mu N against the slip
    kIncipient,  ///< the same while the slip is still so small that it follows what drives it
    kRolling     ///< no slip; friction as much as that takes
};

/// Accelerations and forces [m/s^2: per mass of the ball].
struct SingleContactForces {
    Vec3 normal = Vec3::UnitZ();
    Vec3 normal_rate = Vec3::Zero();  ///< 1/s
    double push = 0;                  ///< along the normal; the contact holds while it is > 0
    Vec3 drive = Vec3::Zero();        ///< b: what would change the slip if there were no friction
    Vec3 slip = Vec3::Zero();         ///< m/s
    Vec3 friction = Vec3::Zero();
    Vec3 acceleration = Vec3::Zero();
    Vec3 spin_rate = Vec3::Zero();  ///< rad/s^2
};

/// With n' the rate of the normal, and f the friction per mass at the arm -R n:
///   v' = g + N n + f,  w' = -(n x f) / (k R),  N = -g.n - v.n',
/// so the slip s = v - R w x n changes along the surface by
///   s' = b + (1 + 1/k) f,  b = g_t - R (w.n) n x n'.
/// Sliding: f = -mu N s/|s|. Rolling keeps s = 0: f = -k/(1+k) b, which Coulomb allows up to mu N.
/// (E. J. Routh, Dynamics of a System of Rigid Bodies, Advanced Part, 1905, ch. V; the term with
/// w.n turns a ball that rolls obliquely on a cylinder.) What n' is for a velocity is the feature's
/// to say (Feature::motion_at): all that the law knows of the surface's curvatures.
///
/// Rolling resistance adds -r v/|v| to the friction of a roll, and a moment that keeps s = 0, as on
/// a flat surface (flat_contact.h). Pivoting takes p N/(k R^2) off the spin about n, which the
/// turning normal changes by w.n'; it holds a spin that is 0 against as much.
SingleContactForces single_contact_forces(const SingleContact& contact, ContactMode mode,
                                          const ContactState& state);

/// Below this push [m/s^2] the ball has left, a negative trifle: its path must part from the
/// surface by more than the rounding of its place, which is what the next time of impact sees.
double lift_off_threshold(const SingleContact& contact, const Vec3& x);

/// What rolling resistance takes off a roll along the unit vector `along` [m/s^2]: its law's, or
/// what friction has left where that is less.
double rolling_resistance(const SingleContact& contact, const SingleContactForces& forces,
                          const Vec3& along);

/// Whether rolling resistance holds a ball that stands where gravity pulls it along the surface.
bool holds_still(const SingleContact& contact, const SingleContactForces& forces);

/// p N/(k R^2) - |w.n'|: a spin about the normal that is 0 stays so while this is >= 0 [rad/s^2].
double pivot_hold_left(const SingleContact& contact, const SingleContactForces& forces,
                       const ContactState& state);

/// Takes the spin about the normal away where it is no more than `still` [rad/s], and says which
/// way it goes on: 0 where friction holds it, as it does all spins without pivoting.
int pivot_of(const SingleContact& contact, ContactMode mode, ContactState& state, double still);

/// mu N - |f| of rolling, without its resistance: it rolls while this is >= 0.
double grip_left(const SingleContact& contact, const SingleContactForces& forces);

/// Ends what is left of a slip by the impulse of friction that this takes: momentum and energy go
/// with it.
void end_slip(const SingleContact& contact, ContactState& state);

/// Kinetic and potential energy of a ball in `a` less those in `b`, per mass [m^2/s^2].
double energy_difference(const ContactState& a, const ContactState& b, double radius,
                         double inertia_factor, const Vec3& gravity);

/// The energy per mass that is in play [m^2/s^2]: kinetic, and that of a fall by the radius.
double energy_in_play(const ContactState& state, double radius, double inertia_factor,
                      const Vec3& gravity);

/// Puts rounding right: the centre on its distance, the velocity along the surface and, when it
/// rolls, no slip.
void project(const SingleContact& contact, ContactMode mode, ContactState& state);

}  // namespace carom
