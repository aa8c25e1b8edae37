// An inset plot of height over time that grows with the film.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/pixel_rect.h"
#include "motion/motion.h"
#include "render/draw2d/font.h"
#include "render/draw2d/style.h"
#include "render/element/element.h"
#include "render/element/plot_curve.h"
#include "render/element/trail_raster.h"
#include "scene/scene.h"

namespace carom {

/// The axes: what they span, and where the grid's lines are.
struct PlotAxes {
    double first_s = 0, last_s = 1, low_m = 0, high_m = 1;
    double step_s = 1, step_m = 1;  ///< between lines: 1, 2 or 5 times a power of ten
};

/// Lowest and highest point that the balls' lowest points reach from film.start on, with 0 where
/// the motion is near it; the ends of the axis of heights are lines of the grid.
PlotAxes choose_plot_axes(const Scene& scene, const Motion& motion, double most_lines_s,
                          double most_lines_m);

/// A plate with axes, drawn once, and the exact curves up to an instant, with a dot at their ends.
/// The picture at t is the same whatever was drawn before.
class PlotElement : public Element {
  public:
    /// `scene` and `motion` must outlive it. Stays clear of what is `taken`. Without room for its
    /// axes its rect() is empty, and it must not be drawn.
    PlotElement(const Scene& scene, const Motion& motion, int width_px, int height_px,
                const std::vector<PixelRect>& taken, const Palette& palette);

    void draw(double t, Image& picture) override;
    Appearance appearance(double t) override;
    PixelRect rect() const override { return rect_; }
    const PlotScale& scale() const { return scale_; }  ///< px from the plate's corner

  private:
    struct Line {
        PlotCurve curve;
        std::optional<TrailPoint> last;
    };

    void choose_place(const std::vector<PixelRect>& taken, int width_px, int height_px);
    void make_plate(const PlotAxes& axes);
    void draw_grid(Canvas& canvas, const PlotAxes& axes) const;
    void draw_names(Canvas& canvas) const;
    double shown_instant(double t) const;
    void start_over();
    void segment(std::size_t line, const TrailPoint& to, bool for_good);

    const Scene& scene_;
    const Motion& motion_;
    Palette palette_;
    Font font_;
    double unit_;  ///< px of a picture of 720 lines
    PixelRect rect_;
    double left_px_ = 0, top_px_ = 0, right_px_ = 0, bottom_px_ = 0;  ///< of the axes, on the plate
    PlotScale scale_;
    Image plate_;
    std::vector<Ink> inks_;
    std::vector<Line> lines_;
    std::optional<TrailRaster> curves_;
    double last_ = 0;
};

ElementKind plot_kind();

}  // namespace carom
