#include "render/overlay_clock.h"

#include <cairo.h>
#include <fmt/format.h>

#include <cmath>

#include "render/overlay_style.h"

namespace carom {

namespace {

constexpr double kClockPx = 17;  // letters, at 720

int whole(double px) { return static_cast<int>(std::ceil(px)); }

}  // namespace

OverlayClock::OverlayClock(const ClockOptions& options, double longest_s, int width_px,
                           int height_px, const std::string& font_family)
    : font_(font_family, letters_px(kClockPx, height_px)), digits_(options.digits) {
    length_ = fmt::format("{:.{}f}", std::max(longest_s, 0.0), digits_).size();
    const double size = font_.size_px();
    const TextRun before = font_.lay_out("t = "), after = font_.lay_out(" s");
    const TextRun point = font_.lay_out(".");
    cell_px_ = static_cast<int>(std::lround(font_.digit_width_px()));
    point_px_ = whole(point.width_px);

    const int side = whole(0.62 * size);
    number_x_ = side + whole(before.width_px);
    const int point_count = digits_ > 0 ? 1 : 0;
    const int number_px =
        (static_cast<int>(length_) - point_count) * cell_px_ + point_count * point_px_;
    const int width = number_x_ + number_px + whole(after.width_px) + side;
    const int height = whole(1.75 * size);
    const int border = whole(std::max(overlay_px(18, height_px), 5.0));
    const Corner corner = options.corner;
    const bool left = corner == Corner::kTopLeft || corner == Corner::kBottomLeft;
    const bool top = corner == Corner::kTopLeft || corner == Corner::kTopRight;
    x_ = left ? border : width_px - border - width;
    y_ = top ? border : height_px - border - height;

    // On a whole row, so that digits stay sharp.
    const double base = std::round(0.5 * (height + font_.cap_height_px()));
    plate_ = Image(width, height);
    Canvas canvas(plate_);
    canvas.round_rect(0.5, 0.5, width - 1, height - 1, 0.36 * size);
    canvas.use({kPaper.r, kPaper.g, kPaper.b, 0.74});
    cairo_fill_preserve(canvas.context());
    canvas.use({kSlate.r, kSlate.g, kSlate.b, 0.14});
    cairo_set_line_width(canvas.context(), 1);
    cairo_stroke(canvas.context());
    font_.draw(canvas, before, side, base, kSlate);
    font_.draw(canvas, after, number_x_ + number_px, base, kSlate);
    canvas.finish();

    const auto cell = [&](const TextRun& run, int cell_width) {
        Image picture(cell_width, height);
        Canvas drawing(picture);
        font_.draw(drawing, run, 0.5 * (cell_width - run.width_px), base, kSlate);
        drawing.finish();
        return picture;
    };
    for (std::size_t d = 0; d < digit_.size(); ++d)
        digit_[d] = cell(font_.lay_out(std::to_string(d)), cell_px_);
    point_ = cell(point, point_px_);
}

std::string OverlayClock::text(double t) const {
    // The last frame must not read "-0.00", nor widen the number.
    return fmt::format("{:>{}.{}f}", std::max(t, 0.0), length_, digits_);
}

OverlayPainter::Rect OverlayClock::rect() const {
    return {x_, y_, plate_.width_px, plate_.height_px};
}

void OverlayClock::draw(double t, Image& picture) const {
    lay_over(plate_, x_, y_, picture);
    int x = x_ + number_x_;
    for (const char c : text(t)) {
        if (c >= '0' && c <= '9')
            lay_over(digit_[static_cast<std::size_t>(c - '0')], x, y_, picture);
        if (c == '.') lay_over(point_, x, y_, picture);
        x += c == '.' ? point_px_ : cell_px_;
    }
}

}  // namespace carom
