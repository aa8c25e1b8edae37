// Two runs beside each other: two pictures by the same camera, and what stands over both.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "render/overlay.h"
#include "render/painter.h"
#include "render/two_runs.h"

namespace carom {

/// What a half of a picture is told by the whole.
struct PicturePart {
    Camera camera;                            ///< at the motion's start
    const Motion* camera_motion = nullptr;    ///< what `camera` follows
    const JoinedRuns* joined = nullptr;       ///< where the ruler stands
    std::vector<OverlayPainter::Rect> taken;  ///< by the whole picture, in the half's pixels
};

/// The first run on the left, the second on the right, a thin divider between them; each with a
/// caption that says what differs. Clock, title, caption and the distance stand over the whole.
class SideBySide {
  public:
    /// All must outlive it.
    SideBySide(const Scene& scene, const Motion& motion, const PainterOptions& whole);

    void paint(const std::vector<double>& instants, Image& out);
    std::string renderer() const { return left_->renderer(); }
    std::map<std::string, Painter::DrawnEffect> effects() const;
    double draw_cpu_s() const;
    double read_cpu_s() const { return left_->read_cpu_s() + right_->read_cpu_s(); }

    /// Width of the divider; what is left is even, so that both halves are equal.
    static int divider_px(int width_px, int height_px);

  private:
    Scene half_scene(const Scene& scene, bool second) const;
    PicturePart part_of(const Motion& motion) const;

    const SecondRun& second_;
    int width_px_, height_px_, divider_px_, half_px_;
    JoinedRuns joined_;
    Scene whole_scene_, left_scene_, right_scene_;  ///< what stands over all, and in the halves
    Ink divider_;
    std::unique_ptr<OverlayPainter> overlay_;
    PicturePart part_;
    std::unique_ptr<Painter> left_, right_;
    Image left_picture_, right_picture_;
    double over_cpu_s_ = 0;
};

}  // namespace carom
