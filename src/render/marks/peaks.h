// Ghost marks where the balls turned, with the heights that they reached.
#pragma once

#include <string>
#include <vector>

#include "core/image.h"
#include "core/pixel_rect.h"
#include "motion/motion.h"
#include "render/draw2d/font.h"
#include "render/draw2d/style.h"
#include "render/element/element.h"
#include "render/view/camera.h"
#include "scene/scene.h"

namespace carom {

/// One peak of one ball. The height is the gap under the ball, as in Motion::peaks.
struct PeakMark {
    int ball = 0;
    double time = 0;             ///< s; seen from then on
    Vec3 center = Vec3::Zero();  ///< of the ball, m
    Vec2 foot = Vec2::Zero();    ///< the ball's lowest point, px
    double radius_px = 0;
    std::string text;      ///< "1.29 m"
    PixelRect place;       ///< of the text; empty where there is no room for it
    bool at_right = true;  ///< of the ball; else at its left
};

/// Every peak whose mark can be told from those before it, in order of time. Places depend on
/// earlier peaks only, so that a number stays where it first appeared; no two overlap each other or
/// `taken`, and all lie inside the picture. Numbers leave room for the balls' labels.
std::vector<PeakMark> lay_out_peaks(const Scene& scene, const Motion& motion, const View& view,
                                    const Font& font, const std::vector<PixelRect>& taken);

/// The outline of a ball as `view` sees it, exact in perspective; empty if the eye is inside.
std::vector<Vec2> silhouette(const Vec3& center, double radius, const View& view);

/// A picture to which each frame adds the marks that are new.
class PeaksElement : public Element {
  public:
    PeaksElement(const Scene& scene, const Motion& motion, const View& view,
                 const std::vector<PixelRect>& taken, const Palette& palette);

    void set_view(const View& view, const std::vector<PixelRect>& around) override;

    PixelRect update(double t) override;
    const Image& picture() const override { return picture_; }

  private:
    void draw_mark(Canvas& canvas, const PeakMark& mark) const;

    const Scene& scene_;
    const Motion& motion_;
    View view_;
    Palette palette_;
    Font font_;
    std::vector<PeakMark> marks_;
    std::size_t drawn_ = 0;  ///< marks in the picture
    bool stale_ = false;     ///< the picture is another view's
    Image picture_;
};

ElementKind peaks_kind();

}  // namespace carom
