// The names of the balls, beside them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/types.h"
#include "motion/motion.h"
#include "render/font.h"
#include "render/overlay.h"
#include "render/overlay_style.h"
#include "scene/scene.h"

namespace carom {

/// Where a label would like to be: centred on `center_x`, its lower edge at `bottom_y`, px.
struct LabelWish {
    bool in_picture = true;  ///< false where the ball is not seen
    double center_x = 0;
    double bottom_y = 0;
    int width = 0, height = 0;
};

/// Where it is; nothing if there is no room for it.
struct LabelPlace {
    OverlayPainter::Rect rect;
    bool away = false;  ///< far enough from its ball to need a line to it
};

/// Moves labels apart to the left and right as far as `close` asks: close(i, j), i < j, is 1 for a
/// pair that must not share any column of pixels, 0 for one that may, and in between goes smoothly.
void spread_labels(std::vector<LabelWish>& wishes, const Eigen::MatrixXd& close);

/// Finds places for labels one after another: each stays where it wants to be, or gives way to
/// those before it. No two places overlap each other or `obstacles`, and all lie inside the
/// picture.
std::vector<std::optional<LabelPlace>> place_labels(
    const std::vector<LabelWish>& wishes, int width_px, int height_px,
    const std::vector<OverlayPainter::Rect>& obstacles);

/// "table_tennis" as people write it.
std::string label_text(const std::string& name);

/// A label stays above its ball. Where two come level with each other, or will within half a second
/// of film, or did, they make room to the sides: as the motion is known for all times, a label
/// moves before it must, and does not jump. All of it depends on t alone, not on the frames before.
class OverlayLabels {
  public:
    /// `scene`, `motion` must outlive it.
    OverlayLabels(const Scene& scene, const Motion& motion, const View& view);

    void set_view(const View& view) { view_ = view; }  ///< of the same size

    /// The places at t, one entry per ball.
    std::vector<std::optional<LabelPlace>> place(
        double t, const std::vector<OverlayPainter::Rect>& obstacles) const;
    void draw(double t, const std::vector<OverlayPainter::Rect>& obstacles, Image& picture) const;

  private:
    /// With halo; drawn when it is first shown, for of thousands few have room.
    const Image& picture_of(std::size_t ball) const;
    std::vector<LabelWish> wishes(double t) const;  ///< above the balls
    std::vector<LabelWish> spread_wishes(double t) const;
    /// How level each pair of labels is around t, for spread_labels().
    Eigen::MatrixXd closeness(double t) const;

    const Scene& scene_;
    const Motion& motion_;
    View view_;
    Palette palette_;
    Font font_;
    double halo_px_;
    double gap_px_;               ///< between a ball and its label
    int height_px_ = 0;           ///< of each picture
    std::vector<int> widths_px_;  ///< per ball
    mutable std::vector<Image> pictures_;
};

}  // namespace carom
