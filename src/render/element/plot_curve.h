// Height over time of one ball as a polyline whose corners depend on the motion alone.
#pragma once

#include <cstddef>
#include <optional>

#include "motion/motion.h"
#include "render/element/trail_curve.h"

namespace carom {

/// From seconds and metres to pixels of a plot.
struct PlotScale {
    double left_s = 0, bottom_m = 0;  ///< at the origin of the axes
    double px_per_s = 1, px_per_m = 1;
    Vec2 origin_px = Vec2::Zero();
    Vec2 px(double t, double height) const {
        return origin_px + Vec2((t - left_s) * px_per_s, -(height - bottom_m) * px_per_m);
    }
};

/// Hands out corners in order of time: every start of a piece, so that impacts stay sharp, and
/// between them as many as keep the chord within TrailCurve::kChordError of the exact curve. Where
/// pieces are many in half a pixel, their lowest and their highest point stand for all: corners
/// follow from the plot's width, however long the motion is.
class PlotCurve {
  public:
    /// `trajectory` must outlive it. `below_m` is taken from the centre's height: the radius.
    PlotCurve(const Trajectory& trajectory, double below_m, const PlotScale& scale,
              double duration);

    /// The next corner if it is not later than `limit`.
    std::optional<TrailPoint> next(double limit);
    TrailPoint at(double t) const;

  private:
    /// The half pixel in which a piece starts, by its end, if there are many in it.
    std::optional<double> end_of_crowded(std::size_t piece) const;
    TrailPoint take_crowded(double end);
    double end_of_piece(std::size_t piece) const;
    std::size_t steps_of_piece(std::size_t piece) const;

    const Trajectory* trajectory_;
    double below_m_;
    PlotScale scale_;
    double duration_;
    std::size_t piece_ = 0;
    std::size_t step_ = 0;
    std::size_t steps_ = 1;  ///< of the current piece
    std::optional<Vec2> last_;
    std::optional<TrailPoint> waiting_;  ///< the second corner of a half pixel
};

}  // namespace carom
