// The path of one ball on the screen, as a polyline whose corners depend on the motion alone.
#pragma once

#include <cstddef>
#include <optional>

#include "motion/motion.h"
#include "render/camera.h"

namespace carom {

struct TrailPoint {
    double time = 0;  ///< s
    Vec2 px = Vec2::Zero();
    bool visible = true;  ///< false behind the camera
};

/// Hands out corners in order of time: every start of a piece (so impacts stay sharp), and between
/// them as many as keep the chord within kChordError of the exact curve. A corner nearer than
/// kLeastStep to the one before is left out. Which corners there are does not depend on when or how
/// often they are asked for.
class TrailCurve {
  public:
    static constexpr double kChordError = 0.10;  ///< px
    static constexpr double kLeastStep = 0.10;   ///< px
    static constexpr double kLongestStep = 16;   ///< px; bounds what one frame redraws

    /// `trajectory` and `view` must outlive it.
    TrailCurve(const Trajectory& trajectory, const View& view, double duration);

    /// The next corner if it is not later than `limit`.
    std::optional<TrailPoint> next(double limit);
    TrailPoint at(double t) const;

  private:
    std::size_t steps_of_piece(std::size_t piece) const;
    double end_of_piece(std::size_t piece) const;

    const Trajectory* trajectory_;
    const View* view_;
    double duration_;
    std::size_t piece_ = 0;
    std::size_t step_ = 0;
    std::size_t steps_ = 1;  ///< of the current piece
    std::optional<TrailPoint> last_;
};

}  // namespace carom
