// Which balls may stand between a ball and the lamp.
#pragma once

#include <vector>

#include "render/balls/balls_in_view.h"

namespace carom {

/// A shadow is looked for up to where the lamp looks so many times larger than the ball.
inline constexpr double kLargestLamp = 8;

/// Whether `other` may take light from the ball: between it and the lamp, within the penumbra's
/// reach, or close enough to darken. `light_tan`: of the lamp's angular radius.
bool may_shade(const BallInView& other, const BallInView& ball, const Vec3& to_light,
               double light_tan);

/// Balls sorted into cells by where they stand across the light's direction, so that each ball has
/// to look at its neighbours there instead of at all balls.
class CasterCells {
  public:
    /// `balls` must outlive it.
    CasterCells(const std::vector<BallInView>& balls, const Vec3& to_light);

    /// Numbers of balls, increasing: all whose shadow may reach the ball, and others.
    const std::vector<int>& near(const BallInView& ball) const;

  private:
    int column_of(double across_m) const;
    int row_of(double across_m) const;

    Vec3 u_, v_;  ///< across the light
    Vec2 least_ = Vec2::Zero();
    double cell_m_ = 1;
    int columns_ = 1, rows_ = 1;
    std::vector<std::vector<int>> cells_;
};

}  // namespace carom
