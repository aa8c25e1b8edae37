// The ruler: a graduated staff that stands in the scene beside the motion.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "render/draw2d/font.h"
#include "render/draw2d/style.h"
#include "render/element/element.h"
#include "render/view/camera.h"
#include "render/view/framing.h"

namespace carom {

enum class TickRank { kMajor, kMedium, kMinor };

/// A mark of the scale, where its height projects to.
struct RulerTick {
    double height_m = 0;
    Vec2 px = Vec2::Zero();
    TickRank rank = TickRank::kMinor;
    std::string label;  ///< of major ticks: the height in metres; else empty
};

/// What is drawn of a ruler: the part of the staff that the picture holds, with its ticks upwards.
struct RulerLayout {
    RulerStaff staff;
    Vec2 low_px = Vec2::Zero();  ///< the lower end of the visible part
    Vec2 high_px = Vec2::Zero();
    std::optional<std::array<Vec2, 2>> band_px;  ///< ends of the marked part that is visible
    double major_step_m = 1;
    std::vector<RulerTick> ticks;
};

/// The scene's ruler where this view shows it: left of the motion, or right of it if only that side
/// has room, or at the place that the scene names. Nothing in a picture that is hardly wider than
/// its numbers.
std::optional<RulerStaff> stand_ruler(const Scene& scene, const Motion& motion, const View& view);

/// Steps of 1, 2 or 5 times a power of ten, chosen so that numbers and ticks have room.
/// Nothing if the staff is out of the picture.
std::optional<RulerLayout> lay_out_ruler(const RulerStaff& staff, const View& view);

/// Onto a picture of the view's size.
void draw_ruler(const RulerLayout& layout, const View& view, const Font& font,
                const Palette& palette, Image& picture);

bool has_room_for_ruler(const View& view);

/// Size of the ruler's numbers, px.
double ruler_font_px(const View& view);

/// Stands where the motion of both runs leaves room, where there are two.
class RulerElement : public Element {
  public:
    /// `scene` and `motion` must outlive it.
    RulerElement(const Scene& scene, const Motion& motion, const View& view,
                 const Palette& palette);

    void set_view(const View& view, const std::vector<PixelRect>& around) override;
    /// With its numbers; empty where the view does not show it.
    PixelRect rect() const override;
    void draw(double t, Image& picture) override;

  private:
    const Scene& scene_;
    const Motion& motion_;
    View view_;
    Palette palette_;
    std::optional<RulerLayout> layout_;
    std::optional<Font> font_;  ///< made when a view first shows the ruler
};

ElementKind ruler_kind();

}  // namespace carom
