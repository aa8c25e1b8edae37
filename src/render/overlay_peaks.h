// Ghost marks where the balls turned, with the heights that they reached.
#pragma once

#include <string>
#include <vector>

#include "motion/motion.h"
#include "render/font.h"
#include "render/overlay.h"
#include "render/overlay_style.h"
#include "scene/scene.h"

namespace carom {

/// One peak of one ball. The height is the gap under the ball, as in Motion::peaks.
struct PeakMark {
    int ball = 0;
    double time = 0;             ///< s; seen from then on
    Vec3 center = Vec3::Zero();  ///< of the ball, m
    Vec2 foot = Vec2::Zero();    ///< the ball's lowest point, px
    double radius_px = 0;
    std::string text;            ///< "1.29 m"
    OverlayPainter::Rect place;  ///< of the text; empty where there is no room for it
    bool at_right = true;        ///< of the ball; else at its left
};

/// Every peak whose mark can be told from those before it, in order of time. Places depend on
/// earlier peaks only, so that a number stays where it first appeared; no two overlap each other or
/// `taken`, and all lie inside the picture. Numbers leave room for the balls' labels.
std::vector<PeakMark> lay_out_peaks(const Scene& scene, const Motion& motion, const View& view,
                                    const Font& font,
                                    const std::vector<OverlayPainter::Rect>& taken);

/// The outline of a ball as `view` sees it, exact in perspective; empty if the eye is inside.
std::vector<Vec2> silhouette(const Vec3& center, double radius, const View& view);

/// A picture to which each frame adds the marks that are new.
class OverlayPeaks {
  public:
    OverlayPeaks(const Scene& scene, const Motion& motion, const View& view,
                 const std::vector<OverlayPainter::Rect>& taken, const Palette& palette);

    /// Another view of the same size.
    void set_view(const View& view, const std::vector<OverlayPainter::Rect>& taken);

    /// Returns what changed since the last call.
    OverlayPainter::Rect update(double t);
    const Image& picture() const { return picture_; }

  private:
    void draw(Canvas& canvas, const PeakMark& mark) const;

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

}  // namespace carom
