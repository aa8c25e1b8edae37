// The motion of one ball on a curved contact as a differential equation, and its solutions.
#pragma once

#include <array>
#include <cmath>

#include "sim/law/single_contact.h"

namespace carom {

/// d (way since the start), v, w and the turn since the start: four vectors.
using Numbers = std::array<double, 12>;

inline Vec3 part(const Numbers& y, std::size_t i) { return {y[3 * i], y[3 * i + 1], y[3 * i + 2]}; }
inline void set_part(Numbers& y, std::size_t i, const Vec3& v) {
    for (std::size_t k = 0; k < 3; ++k) y[3 * i + k] = v[static_cast<Eigen::Index>(k)];
}

/// Of the turn u since the start (a rotation vector) at the spin w and its rate b.
Vec3 turn_rate(const Vec3& u, const Vec3& w);
Vec3 turn_second_rate(const Vec3& u, const Vec3& w, const Vec3& b);

/// The differential equation, and its solutions from one state on.
class Course {
  public:
    Course(const CurvedContact& contact, CurvedMode mode, const CurvedState& start)
        : contact_(contact),
          mode_(mode),
          start_(start),
          speed_(start.v.norm() + contact.radius * start.w.norm() +
                 std::sqrt(contact.gravity.norm() * contact.radius)) {}

    Numbers first() const {
        Numbers y{};
        set_part(y, 1, start_.v);
        set_part(y, 2, start_.w);
        return y;
    }
    CurvedState state(const Numbers& y) const {
        return {start_.x + part(y, 0), part(y, 1), part(y, 2)};
    }
    CurvedForces forces(const CurvedState& s) const { return curved_forces(contact_, mode_, s); }

    /// Goes on from y. Throws odeint's own error when it makes no progress.
    void advance(Numbers& y, double seconds) const;

    const CurvedContact& contact() const { return contact_; }
    CurvedMode mode() const { return mode_; }
    const CurvedState& start() const { return start_; }
    /// The size of the speeds at hand, m/s.
    double speed() const { return speed_; }

  private:
    const CurvedContact& contact_;
    CurvedMode mode_;
    const CurvedState& start_;
    double speed_;
};

}  // namespace carom
