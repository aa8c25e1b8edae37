#include "render/overlay_verdict.h"

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/font.h"
#include "render/overlay_labels.h"
#include "render/overlay_style.h"
#include "scene/film_clock.h"

namespace carom {

namespace {

constexpr double kLettersPx = 17;  // at 720
constexpr double kShown_s = 2;     // of film

int whole(double px) { return static_cast<int>(std::ceil(px)); }

/// "basketball: 1.53 m to its top, rule 1.2 to 1.4 m".
std::string plate_text(const Scene& scene, const ReboundVerdict& verdict) {
    const ReboundTest& test = *scene.test;
    const std::string ball = label_text(scene.balls[static_cast<std::size_t>(test.ball)].name);
    const std::string rebound =
        verdict.rebounded
            ? fmt::format("{:.3f} m to its {}", verdict.height_m, test.to_top ? "top" : "bottom")
            : "no rebound";
    return fmt::format("{}: {}, rule {} to {} m", ball, rebound, test.low_m, test.high_m);
}

}  // namespace

OverlayVerdict::OverlayVerdict(const Scene& scene, const Motion& motion,
                               const ReboundVerdict& verdict, int width_px, int height_px,
                               const std::vector<OverlayPainter::Rect>& taken,
                               const std::string& font_family, const Palette& palette)
    : from_s_(
          std::max(verdict.time_s,
                   motion_time(scene.film, film_time(scene.film, motion.duration) - kShown_s))) {
    const std::string word = verdict.passes ? "passes" : "does not pass";
    double letters = letters_px(kLettersPx, height_px);
    // Narrow pictures get smaller letters rather than a plate that hangs out.
    const Font wanted(font_family, letters);
    const TextRun wanted_text = wanted.lay_out(plate_text(scene, verdict) + word + "mmm");
    letters *= std::min(1.0, 0.96 * width_px / wanted_text.width_px);
    const Font font(font_family, letters);
    const TextRun verdict_run = font.lay_out(word);
    const TextRun text = font.lay_out(plate_text(scene, verdict));

    const double size = font.size_px(), side = 0.62 * size;
    const int height = whole(1.75 * size);
    const double head = verdict_run.width_px + 2 * side;
    const int width = whole(head + text.width_px + 2 * side);
    plate_ = Image(width, height);
    Canvas canvas(plate_);
    canvas.round_rect(0.5, 0.5, width - 1, height - 1, 0.36 * size);
    canvas.use(with_alpha(palette.paper, 0.88));
    cairo_fill_preserve(canvas.context());
    const Ink& ink = verdict.passes ? palette.good : palette.bad;
    cairo_save(canvas.context());
    cairo_clip(canvas.context());
    canvas.use(ink);
    cairo_rectangle(canvas.context(), 0, 0, head, height);
    cairo_fill(canvas.context());
    cairo_restore(canvas.context());
    const double base = std::round(0.5 * (height + font.cap_height_px()));
    font.draw(canvas, verdict_run, side, base, palette.paper);
    font.draw(canvas, text, head + side, base, palette.ink);
    canvas.finish();

    const int border = whole(std::max(overlay_px(18, height_px), 5.0));
    rect_ = {(width_px - width) / 2, border, width, height};
    // Below one it may meet the next, whatever their order.
    for (std::size_t turn = 0; turn < taken.size(); ++turn)
        for (const OverlayPainter::Rect& other : taken)
            if (rect_.overlaps(other)) rect_.y = other.bottom() + border / 2;
}

void OverlayVerdict::draw(Image& picture) const { lay_over(plate_, rect_.x, rect_.y, picture); }

}  // namespace carom
