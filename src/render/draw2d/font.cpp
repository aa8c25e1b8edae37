#include "render/draw2d/font.h"

#include <cairo.h>

#include <algorithm>
#include <memory>

#include "render/draw2d/typeface.h"

namespace carom {

namespace {

double top_of(const Glyph& glyph) {
    double top = 0;
    for (const Glyph::Segment& segment : glyph.segments) top = std::max(top, segment.points[0].y());
    return top;
}

/// The glyph's outline from the pen at (x, y) as a part of the path.
void add_outline(cairo_t* c, const Glyph& glyph, double x, double y, double size_px) {
    const auto px = [&](const Vec2& em) { return x + size_px * em.x(); };
    const auto py = [&](const Vec2& em) { return y - size_px * em.y(); };
    for (const Glyph::Segment& segment : glyph.segments) {
        const auto& [a, b, d] = segment.points;
        switch (segment.kind) {
            case Glyph::Segment::Kind::kMove:
                if (&segment != &glyph.segments.front()) cairo_close_path(c);
                cairo_move_to(c, px(a), py(a));
                break;
            case Glyph::Segment::Kind::kLine:
                cairo_line_to(c, px(a), py(a));
                break;
            case Glyph::Segment::Kind::kCurve:
                cairo_curve_to(c, px(a), py(a), px(b), py(b), px(d), py(d));
                break;
        }
    }
    if (!glyph.segments.empty()) cairo_close_path(c);
}

}  // namespace

Font::Font(double size_px) : size_px_(size_px) {
    const Typeface& typeface = overlay_typeface();
    for (char32_t digit = U'0'; digit <= U'9'; ++digit)
        digit_width_px_ = std::max(digit_width_px_, size_px * typeface.glyph(digit).advance_em);
    cap_height_px_ = size_px * top_of(typeface.glyph(U'H'));
}

TextRun Font::lay_out(std::string_view utf8) const {
    const Typeface& typeface = overlay_typeface();
    TextRun run;
    run.glyphs.reserve(utf8.size());
    while (!utf8.empty()) {
        const char32_t character = take_character(utf8);
        const Glyph& glyph = typeface.glyph(character);
        const double own = size_px_ * glyph.advance_em;
        const bool digit = character >= U'0' && character <= U'9';
        const double cell = digit ? digit_width_px_ : own;
        run.glyphs.push_back({&glyph, run.width_px + 0.5 * (cell - own)});
        run.width_px += cell;
    }
    return run;
}

void Font::draw(Canvas& canvas, const TextRun& run, double x, double y, const Ink& ink,
                double halo_px, const Ink& halo) const {
    cairo_t* c = canvas.context();
    cairo_new_path(c);
    for (const TextRun::Place& place : run.glyphs)
        add_outline(c, *place.glyph, x + place.x_px, y, size_px_);
    // As lines: cairo's releases differ in how they stroke a curve.
    const std::unique_ptr<cairo_path_t, decltype(&cairo_path_destroy)> lines(
        cairo_copy_path_flat(c), cairo_path_destroy);
    cairo_new_path(c);
    cairo_append_path(c, lines.get());
    cairo_set_line_join(c, CAIRO_LINE_JOIN_ROUND);
    // A faint wide stroke below a firmer narrow one fades softly into any background.
    for (const auto& [width, alpha] : {std::pair(2.0, 0.35), std::pair(1.2, 0.70)}) {
        if (halo_px <= 0) break;
        canvas.use({halo.r, halo.g, halo.b, alpha});
        cairo_set_line_width(c, width * halo_px);
        cairo_stroke_preserve(c);
    }
    canvas.use(ink);
    cairo_fill(c);
}

}  // namespace carom
