// The names of the balls, beside them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/pixel_rect.h"
#include "core/types.h"
#include "motion/motion.h"
#include "render/draw2d/font.h"
#include "render/draw2d/style.h"
#include "render/element/element.h"
#include "render/marks/label_rise.h"
#include "render/view/camera.h"
#include "scene/scene.h"

namespace carom {

/// How far to either side labels look for others that come level with them, s of film.
inline constexpr double kLevelReach_s = 0.5;
/// How far to either side of an instant what is drawn at it depends on where balls are, s of film:
/// how labels rise, over what lasts, from places that level ones have left.
inline constexpr double kLabelReach_s = LabelRises::kReach_s + LabelRises::kBrief_s + kLevelReach_s;

/// Where a label would like to be: centred on `center_x`, its lower edge at `bottom_y`, px.
struct LabelWish {
    bool in_picture = true;  ///< false where the ball is not seen
    double center_x = 0;
    double bottom_y = 0;
    int width = 0, height = 0;
};

/// Where it is; nothing if there is no room for it.
struct LabelPlace {
    PixelRect rect;
    bool away = false;   ///< far enough from its ball to need a line to it
    double opacity = 1;  ///< less where it is about to be dropped
};

/// Moves labels apart to the left and right as far as `close` asks: close(i, j), i < j, is 1 for a
/// pair that must not share any column of pixels, 0 for one that may, and in between goes smoothly.
void spread_labels(std::vector<LabelWish>& wishes, const Eigen::MatrixXd& close);

/// Finds places for labels one after another: each stays where it wants to be, or gives way to
/// those before it. No two places overlap each other or `obstacles`, and all lie inside the
/// picture.
std::vector<std::optional<LabelPlace>> place_labels(const std::vector<LabelWish>& wishes,
                                                    int width_px, int height_px,
                                                    const std::vector<PixelRect>& obstacles);

/// A label stays above its ball, and above other balls that would lie below it for longer than a
/// moment (label_rise.h); where that is too far from its own, it fades and is dropped. Where two
/// come level with each other, or will within half a second of film, or did, they make room to the
/// sides: as the motion is known for all times, a label moves before it must, and does not jump.
/// All of it depends on t alone, not on the frames before.
class LabelsElement : public Element {
  public:
    /// `scene`, `motion` must outlive it. Labels stay clear of what is `taken`.
    LabelsElement(const Scene& scene, const Motion& motion, const View& view,
                  std::vector<PixelRect> taken = {});

    void set_view(const View& view, const std::vector<PixelRect>& around) override;

    /// The places at t, one entry per ball.
    std::vector<std::optional<LabelPlace>> place(double t,
                                                 const std::vector<PixelRect>& obstacles) const;
    void draw(double t, Image& picture) override;
    Appearance appearance(double t) override;

  private:
    /// With halo; drawn when it is first shown, for of thousands few have room.
    const Image& picture_of(std::size_t ball) const;
    std::vector<LabelWish> wishes(double t) const;  ///< above the balls
    std::vector<LabelWish> spread_wishes(double t) const;
    void draw_lines(const std::vector<std::optional<LabelPlace>>& places,
                    const std::vector<LabelWish>& balls, Image& picture) const;
    /// How far each has to rise over other balls, at an instant of the film.
    std::vector<double> ways_up(double film_s) const;
    /// How level each pair of labels is around t, for spread_labels().
    Eigen::MatrixXd closeness(double t) const;

    const Scene& scene_;
    const Motion& motion_;
    View view_;
    bool view_moves_ = false;
    std::vector<PixelRect> taken_;
    Palette palette_;
    Font font_;
    double halo_px_;
    double gap_px_;               ///< between a ball and its label
    int height_px_ = 0;           ///< of each picture
    std::vector<int> widths_px_;  ///< per ball
    mutable std::vector<Image> pictures_;
    mutable LabelRises rises_;
    /// What is drawn at an instant: the last that was asked for.
    struct Drawn {
        double t = 0;
        std::vector<std::optional<LabelPlace>> places;
        std::vector<LabelWish> balls;
    };
    const Drawn& drawn_at(double t);
    std::optional<Drawn> drawn_;
};

ElementKind labels_kind();

}  // namespace carom
