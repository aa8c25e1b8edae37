#include "render/overlay_verdict.h"

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "render/font.h"
#include "render/overlay_labels.h"
#include "render/overlay_style.h"
#include "scene/film_clock.h"

namespace carom {

namespace {

constexpr double kLettersPx = 17;  // at 720
constexpr double kShown_s = 2;     // of film

int whole(double px) { return static_cast<int>(std::ceil(px)); }

/// What a plate says: "passes" | "basketball:" "1.53 m to its top," "rule 1.2 to 1.4 m".
struct Said {
    std::string verdict;
    std::array<std::string, 3> rest;
    std::string in_one_line() const { return rest[0] + ' ' + rest[1] + ' ' + rest[2]; }
};

Said say(const Scene& scene, const ReboundVerdict& verdict) {
    const ReboundTest& test = *scene.test;
    const std::string rebound =
        verdict.rebounded
            ? fmt::format("{:.3f} m to its {}", verdict.height_m, test.to_top ? "top" : "bottom")
            : "no rebound";
    return {verdict.passes ? "passes" : "does not pass",
            {label_text(scene.balls[static_cast<std::size_t>(test.ball)].name) + ":", rebound + ",",
             fmt::format("rule {} to {} m", test.low_m, test.high_m)}};
}

/// Rows of text on paper, the first part of it in the colour of the verdict.
class Plate {
  public:
    Plate(const Font& font, const Palette& palette, bool passes)
        : font_(font),
          palette_(palette),
          ink_(passes ? palette.good : palette.bad),
          side_(0.62 * font.size_px()),
          row_(whole(1.75 * font.size_px())) {}

    Image in_one_line(const Said& said) const {
        const TextRun verdict = font_.lay_out(said.verdict);
        const TextRun text = font_.lay_out(said.in_one_line());
        const double head = verdict.width_px + 2 * side_;
        Image plate(whole(head + text.width_px + 2 * side_), row_);
        Canvas canvas = paper(plate, head, row_);
        font_.draw(canvas, verdict, side_, base(0), palette_.paper);
        font_.draw(canvas, text, head + side_, base(0), palette_.ink);
        canvas.finish();
        return plate;
    }

    Image in_rows(const Said& said) const {
        const TextRun verdict = font_.lay_out(said.verdict);
        std::vector<TextRun> rows;
        double widest = verdict.width_px;
        for (const std::string& text : said.rest) {
            rows.push_back(font_.lay_out(text));
            widest = std::max(widest, rows.back().width_px);
        }
        Image plate(whole(widest + 2 * side_), row_ * (1 + static_cast<int>(rows.size())));
        Canvas canvas = paper(plate, plate.width_px, row_);
        font_.draw(canvas, verdict, side_, base(0), palette_.paper);
        for (std::size_t i = 0; i < rows.size(); ++i)
            font_.draw(canvas, rows[i], side_, base(static_cast<int>(i) + 1), palette_.ink);
        canvas.finish();
        return plate;
    }

  private:
    /// With a head of the given size.
    Canvas paper(Image& plate, double head_width, double head_height) const {
        Canvas canvas(plate);
        canvas.round_rect(0.5, 0.5, plate.width_px - 1, plate.height_px - 1,
                          0.36 * font_.size_px());
        canvas.use(with_alpha(palette_.paper, 0.88));
        cairo_fill_preserve(canvas.context());
        cairo_save(canvas.context());
        cairo_clip(canvas.context());
        canvas.use(ink_);
        cairo_rectangle(canvas.context(), 0, 0, head_width, head_height);
        cairo_fill(canvas.context());
        cairo_restore(canvas.context());
        return canvas;
    }
    double base(int row) const {
        return row * row_ + std::round(0.5 * (row_ + font_.cap_height_px()));
    }

    const Font& font_;
    const Palette& palette_;
    Ink ink_;
    double side_;
    int row_;
};

bool overlaps_any(const OverlayPainter::Rect& rect,
                  const std::vector<OverlayPainter::Rect>& others) {
    return std::any_of(others.begin(), others.end(),
                       [&](const OverlayPainter::Rect& other) { return rect.overlaps(other); });
}

/// Down from where it is until it is clear of all that is written.
OverlayPainter::Rect below(OverlayPainter::Rect rect,
                           const std::vector<OverlayPainter::Rect>& written, int gap) {
    // Below one it may meet the next, whatever their order.
    for (std::size_t turn = 0; turn < written.size(); ++turn)
        for (const OverlayPainter::Rect& other : written)
            if (rect.overlaps(other)) rect.y = other.bottom() + gap;
    return rect;
}

}  // namespace

OverlayVerdict::OverlayVerdict(const Scene& scene, const Motion& motion,
                               const ReboundVerdict& verdict, int width_px, int height_px,
                               const std::vector<OverlayPainter::Rect>& written,
                               const std::vector<OverlayPainter::Rect>& taken,
                               const Palette& palette)
    : from_s_(
          std::max(verdict.time_s,
                   motion_time(scene.film, film_time(scene.film, motion.duration) - kShown_s))) {
    const Said said = say(scene, verdict);
    const double letters = letters_px(kLettersPx, height_px);
    const Font wanted(letters);
    // Narrow pictures get smaller letters rather than a plate that hangs out.
    const double in_line = wanted.lay_out(said.in_one_line() + said.verdict + "mmm").width_px;
    const double fitting = letters * std::min(1.0, 0.96 * width_px / in_line);
    if (fitting < kLeastLetters) return;
    const Font narrow(fitting);
    plate_ = Plate(narrow, palette, verdict.passes).in_one_line(said);

    using Rect = OverlayPainter::Rect;
    const int border = whole(std::max(overlay_px(18, height_px), 5.0)), gap = border / 2;
    const auto free = [&](const Rect& rect) {
        return rect.bottom() <= height_px - gap && !overlaps_any(rect, taken);
    };
    const int middle = (width_px - plate_.width_px) / 2, row = plate_.height_px;
    const Rect top = below({middle, border, plate_.width_px, row}, written, gap);
    const Rect bottom{middle, height_px - gap - row, plate_.width_px, row};
    rect_ = free(top) || !free(bottom) ? top : bottom;
    if (free(rect_)) return;

    Image rows = Plate(wanted, palette, verdict.passes).in_rows(said);
    const int w = rows.width_px, h = rows.height_px;
    for (const int x : {border, width_px - border - w}) {
        const Rect aside = below({x, border, w, h}, written, gap);
        if (!free(aside)) continue;
        rect_ = aside;
        plate_ = std::move(rows);
        return;
    }
}

void OverlayVerdict::draw(Image& picture) const { lay_over(plate_, rect_.x, rect_.y, picture); }

}  // namespace carom
