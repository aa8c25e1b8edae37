// The path of one ball on the screen, as a polyline whose corners depend on the motion alone.
#pragma once

#include <cstddef>
#include <optional>

#include "motion/motion.h"
#include "render/view/camera.h"

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
///
/// Where very many pieces are shown at once it hands out every n-th of those with corners of their
/// own, with invisible corners between them: they cover one another many times.
class TrailCurve {
  public:
    static constexpr double kChordError = 0.10;  ///< px
    static constexpr double kLeastStep = 0.10;   ///< px
    static constexpr double kLongestStep = 16;   ///< px; bounds what one frame redraws

    static constexpr std::size_t kManyPieces = 20'000;

    /// `trajectory` and `view` must outlive it. What lasts `shown_s` is shown at once.
    TrailCurve(const Trajectory& trajectory, const View& view, double duration, double shown_s = 0);

    /// Corners of pieces that end before t are not wanted, where they are many.
    void skip_to(double t);

    /// The next corner if it is not later than `limit`.
    std::optional<TrailPoint> next(double limit);
    TrailPoint at(double t) const;

  private:
    bool is_left_out() const;
    std::size_t steps_of_piece(std::size_t piece) const;
    double end_of_piece(std::size_t piece) const;

    const Trajectory* trajectory_;
    const View* view_;
    double duration_;
    std::size_t stride_;  ///< from one piece that is handed out to the next
    std::size_t piece_ = 0;
    std::size_t step_ = 0;
    std::size_t steps_ = 1;  ///< of the current piece
    std::optional<TrailPoint> last_;
    bool pen_up_ = false;  ///< what was left out comes before the next corner
};

}  // namespace carom
