// How far labels rise so that they do not lie on other balls.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "core/types.h"

namespace carom {

/// A ball as it is seen, px.
struct BallDisc {
    Vec2 center = Vec2::Zero();
    double radius = 0;
    bool in_picture = false;
};

/// A label where it would like to be: above its ball, px.
struct LabelBox {
    double left = 0, right = 0, bottom = 0, height = 0;
};

/// The least way up [px] after which the label of ball `own` lies on no other ball.
double rise_over_balls(const LabelBox& label, std::size_t own, const std::vector<BallDisc>& discs);

/// The ways up of all labels as they change with the film's time. What lies in a label's way for
/// less than kBrief_s is let pass; for the rest it rises before it must, smoothly, and comes down
/// again: what is in the way half a second before and after counts. Made of instants at multiples
/// of a step, so that a film time has one answer, whichever frames are asked for.
class LabelRises {
  public:
    static constexpr double kReach_s = 0.5, kBrief_s = 1;  // of film

    /// `ways_at`: of all labels, at an instant of the film [s after its first frame].
    explicit LabelRises(std::function<std::vector<double>(double film_s)> ways_at);

    std::vector<double> at(double film_s);
    /// What `ways_at` says has changed.
    void forget();

  private:
    const std::vector<double>& ways(std::int64_t step);
    /// The longest of the ways that last: of `ways`, a morphological opening over time.
    double lasting(std::int64_t step, std::size_t label);

    std::function<std::vector<double>(double)> ways_at_;
    std::map<std::int64_t, std::vector<double>> ways_;  ///< by step
};

/// How opaque a label is that had to rise so far: up to two of its heights wholly, then less, and
/// from three on it is dropped.
double opacity_of_risen(double rise_px, double height_px);

}  // namespace carom
