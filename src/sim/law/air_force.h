// What air does to a ball.
#pragma once

#include "core/types.h"
#include "scene/scene.h"

namespace carom {

/// Forces of air on one ball, per its mass.
class AirForce {
  public:
    /// Of a ball that no air touches.
    AirForce() = default;
    AirForce(const Air& air, const Ball& ball);

    /// Whether the ball's motion through the air acts on it.
    bool acts() const { return drags_ || lifts_; }
    /// Buoyancy over weight: gravity less this part of it is what pulls the ball.
    double buoyant_part() const { return buoyant_part_; }
    /// 1/s: the spin falls by exp(-rate t) in flight.
    double spin_decay() const { return spin_decay_; }

    /// Drag against u and lift along w x u, u = v - wind; m/s^2.
    Vec3 acceleration(const Vec3& v, const Vec3& w) const {
        return acts() ? through_air(v - wind_, w) : Vec3(Vec3::Zero());
    }

    /// Seconds until a ball at `v` under `pull` [m/s^2] stands still in the air, where it moves
    /// along a line; infinite where it does not, or not by a closed form. There the force has a
    /// bend.
    double until_still(const Vec3& v, const Vec3& w, const Vec3& pull) const;

  private:
    Vec3 through_air(const Vec3& u, const Vec3& w) const;
    double drag_coefficient(double speed) const;
    double lift_coefficient(double spin_ratio) const;

    Drag drag_;
    Lift lift_;
    bool drags_ = false, lifts_ = false;
    Vec3 wind_ = Vec3::Zero();  ///< m/s
    double radius_ = 0;         ///< m
    double per_speed_ = 0;      ///< rho A / (2 m), 1/m
    double reynolds_ = 0;       ///< 2 r rho / viscosity, s/m
    double spin_decay_ = 0;     ///< 1/s
    double buoyant_part_ = 0;
};

}  // namespace carom
