#include "render/plates/verdict.h"

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "render/draw2d/font.h"
#include "render/draw2d/style.h"
#include "scene/film_clock.h"

namespace carom {

namespace {

constexpr double kLettersPx = 17;  // at 720
constexpr double kShown_s = 2;     // of film

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
          row_(whole_px(1.75 * font.size_px())) {}

    Image in_one_line(const Said& said) const {
        const TextRun verdict = font_.lay_out(said.verdict);
        const TextRun text = font_.lay_out(said.in_one_line());
        const double head = verdict.width_px + 2 * side_;
        Image plate(whole_px(head + text.width_px + 2 * side_), row_);
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
        Image plate(whole_px(widest + 2 * side_), row_ * (1 + static_cast<int>(rows.size())));
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

bool overlaps_any(const PixelRect& rect, const std::vector<PixelRect>& others) {
    return std::any_of(others.begin(), others.end(),
                       [&](const PixelRect& other) { return rect.overlaps(other); });
}

/// Down from where it is until it is clear of all that is written.
PixelRect below(PixelRect rect, const std::vector<PixelRect>& written, int gap) {
    // Below one it may meet the next, whatever their order.
    for (std::size_t turn = 0; turn < written.size(); ++turn)
        for (const PixelRect& other : written)
            if (rect.overlaps(other)) rect = rect.with_top(other.bottom + gap);
    return rect;
}

}  // namespace

VerdictElement::VerdictElement(const Scene& scene, const Motion& motion,
                               const ReboundVerdict& verdict, int width_px, int height_px,
                               const std::vector<PixelRect>& written,
                               const std::vector<PixelRect>& taken, const Palette& palette)
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

    const int border = border_px(height_px), gap = border / 2;
    const auto free = [&](const PixelRect& rect) {
        return rect.bottom <= height_px - gap && !overlaps_any(rect, taken);
    };
    const int middle = (width_px - plate_.width_px) / 2, row = plate_.height_px;
    const PixelRect top = below(PixelRect::at(middle, border, plate_.width_px, row), written, gap);
    const PixelRect bottom = PixelRect::at(middle, height_px - gap - row, plate_.width_px, row);
    rect_ = free(top) || !free(bottom) ? top : bottom;
    if (free(rect_)) return;

    Image rows = Plate(wanted, palette, verdict.passes).in_rows(said);
    const int w = rows.width_px, h = rows.height_px;
    for (const int x : {border, width_px - border - w}) {
        const PixelRect aside = below(PixelRect::at(x, border, w, h), written, gap);
        if (!free(aside)) continue;
        rect_ = aside;
        plate_ = std::move(rows);
        return;
    }
}

Appearance VerdictElement::appearance(double t) {
    return shown_at(t) ? Appearance{{rect_}, {}} : Appearance{};
}

void VerdictElement::draw(double t, Image& picture) {
    if (shown_at(t)) lay_over(plate_, rect_.left, rect_.top, picture);
}

ElementKind verdict_kind() {
    ElementKind kind;
    kind.keeps_place = true;
    kind.name = "verdict";
    kind.wanted = [](const Scene& scene) { return scene.test.has_value(); };
    kind.why = "the scene has a test";
    kind.why_not = "the scene has no test";
    kind.make = [](const ElementContext& context) -> std::unique_ptr<Element> {
        const auto verdict = judge_rebound(context.scene, context.motion);
        if (!verdict) return nullptr;
        return std::make_unique<VerdictElement>(context.scene, context.motion, *verdict,
                                                context.view.width_px(), context.view.height_px(),
                                                context.taken, context.around, context.palette);
    };
    return kind;
}

}  // namespace carom
