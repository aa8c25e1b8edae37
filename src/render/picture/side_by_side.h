// Two runs beside each other: two pictures by the same camera, and what stands over both.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "render/overlay/overlay.h"
#include "render/picture/options.h"
#include "render/picture/picture.h"
#include "render/runs/second_run.h"

namespace carom {

/// The first run on the left, the second on the right, a thin divider between them; each with a
/// caption that says what differs. What is said once for both (Repeat) stands over the whole.
class SideBySide : public Picture {
  public:
    /// All must outlive it; `whole.second` is there.
    SideBySide(const Scene& scene, const Motion& motion, const PainterOptions& whole);

    void paint(const std::vector<double>& instants, Image& out) override;
    ChangedParts paint_next(double t, Image& picture) override;
    bool draws_each_anew() const override { return first_->draws_each_anew(); }
    std::string renderer() override { return first_->renderer(); }
    std::map<std::string, DrawnEffect> effects() const override;
    double draw_cpu_s() const override;
    double read_cpu_s() const override { return first_->read_cpu_s() + second_->read_cpu_s(); }

    /// Width of the divider; what is left is even, so that both halves are equal.
    static int divider_px(int width_px, int height_px);

  private:
    void compose(const std::vector<PixelRect>& parts, Image& picture) const;
    PictureHalf half_of(PicturePart part, const Motion& motion) const;

    const SecondRun& run_;
    int width_px_, height_px_, divider_px_, half_px_;
    BothRuns both_;
    Scene second_scene_;  ///< as its half shows it
    Ink divider_;
    OverlayPainter overlay_;  ///< over both halves
    PictureHalf first_half_, second_half_;
    std::unique_ptr<Picture> first_, second_;
    Image first_picture_, second_picture_;
    const std::uint8_t* kept_pixels_ = nullptr;  ///< of the picture that paint_next() goes on with
    double over_cpu_s_ = 0;
};

}  // namespace carom
