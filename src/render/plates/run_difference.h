// What differs between two runs, and how far apart they are: a plate on the picture.
#pragma once

#include <string>
#include <vector>

#include "core/image.h"
#include "core/pixel_rect.h"
#include "motion/motion.h"
#include "render/draw2d/font.h"
#include "render/draw2d/style.h"
#include "render/element/element.h"
#include "render/runs/second_run.h"
#include "render/view/camera.h"
#include "scene/scene.h"

namespace carom {

/// Where balls of both runs are seen in the course of the film, px: what a plate should not cover.
std::vector<Vec2> ball_places(const Motion& motion, const SecondRun& second, const View& view);

/// With ghosts: a line for each value that differs, in both runs, beside a disc and a ring that say
/// which is which. In both views: the greatest distance between balls of equal names at the instant
/// shown.
class RunDifference : public Element {
  public:
    struct Surroundings {
        std::vector<PixelRect> taken{};  ///< it stays clear of these
        std::vector<Vec2> places{};      ///< and covers few of these, px
    };
    /// The motions must outlive it. Without room for letters that could be read its rect() is
    /// empty, and it must not be drawn.
    RunDifference(const Scene& first, const Motion& motion, const SecondRun& second, int width_px,
                  int height_px, const Surroundings& around, const Palette& palette);

    void draw(double t, Image& picture) override;
    Appearance appearance(double t) override;
    PixelRect rect() const override { return rect_; }
    /// The line that changes with time.
    std::string distance_line(double t) const;

  private:
    /// Texts of one line, from the left; a swatch stands before each that has one.
    struct Part {
        enum class Swatch { kNone, kDisc, kRing };
        std::string text;
        Swatch swatch = Swatch::kNone;
        bool muted = false;
    };
    using Line = std::vector<Part>;

    std::vector<Line> legend(bool brief) const;
    double width_of(const Part& part) const;
    /// Sets the columns in which the parts of all lines stand; returns the width of the widest
    /// line.
    double set_columns(const std::vector<Line>& lines);
    double widest_distance() const;
    void make_plate(const std::vector<Line>& lines);
    void draw_line(Canvas& canvas, const Line& line, double y) const;
    void choose_place(int width_px, int height_px, const Surroundings& around);

    const Motion& motion_;
    const SecondRun& second_;
    std::vector<BallPair> pairs_;
    std::vector<std::string> names_;  ///< per pair
    Palette palette_;
    Ink ghost_;
    Font font_;
    std::vector<double> columns_;  ///< from the text's left edge
    double text_y_ = 0;            ///< base line of the distance, from the plate's upper edge
    PixelRect rect_;
    Image plate_;
};

ElementKind run_difference_kind();

}  // namespace carom
