#include "render/overlay_clock.h"

#include <cairo.h>
#include <fmt/format.h>

#include <cmath>

#include "render/overlay_style.h"

namespace carom {

namespace {

constexpr double kClockPx = 17;  // letters, at 720
constexpr const char* kBefore = "t = ";
constexpr const char* kAfter = " s";

int whole(double px) { return static_cast<int>(std::ceil(px)); }

}  // namespace

OverlayClock::OverlayClock(const ClockOptions& options, double longest_s, int width_px,
                           int height_px, const Palette& palette)
    : palette_(palette), digits_(options.digits), picture_width_px_(width_px) {
    const Font font(letters_px(kClockPx, height_px));
    const double size = font.size_px();
    const Corner corner = options.corner;
    at_left_ = corner == Corner::kTopLeft || corner == Corner::kBottomLeft;
    const bool at_top = corner == Corner::kTopLeft || corner == Corner::kTopRight;
    border_px_ = whole(std::max(overlay_px(18, height_px), 5.0));
    side_px_ = whole(0.62 * size);
    height_px_ = whole(1.75 * size);
    y_ = at_top ? border_px_ : height_px - border_px_ - height_px_;
    // On a whole row, so that digits stay sharp.
    base_px_ = std::round(0.5 * (height_px_ + font.cap_height_px()));

    const TextRun point = font.lay_out(".");
    number_px_ = side_px_ + whole(font.lay_out(kBefore).width_px);
    cell_px_ = static_cast<int>(std::lround(font.digit_width_px()));
    point_px_ = whole(point.width_px);
    shortest_ = text(0).size();
    const int fraction_px = digits_ > 0 ? point_px_ + digits_ * cell_px_ : 0;
    const auto longest = static_cast<int>(text(longest_s).size() - shortest_) + 1;
    for (int figures = 1; figures <= longest; ++figures)
        plates_.push_back(make_plate(font, figures * cell_px_ + fraction_px));

    const auto cell = [&](const TextRun& run, int cell_width) {
        Image picture(cell_width, height_px_);
        Canvas canvas(picture);
        font.draw(canvas, run, 0.5 * (cell_width - run.width_px), base_px_, palette_.ink);
        canvas.finish();
        return picture;
    };
    for (std::size_t d = 0; d < digit_.size(); ++d)
        digit_[d] = cell(font.lay_out(std::to_string(d)), cell_px_);
    point_ = cell(point, point_px_);
}

OverlayClock::Plate OverlayClock::make_plate(const Font& font, int number_px) const {
    const TextRun before = font.lay_out(kBefore), after = font.lay_out(kAfter);
    const int width = number_px_ + number_px + whole(after.width_px) + side_px_;
    Plate plate{at_left_ ? border_px_ : picture_width_px_ - border_px_ - width,
                Image(width, height_px_)};
    Canvas canvas(plate.picture);
    canvas.round_rect(0.5, 0.5, width - 1, height_px_ - 1, 0.36 * font.size_px());
    canvas.use(with_alpha(palette_.paper, 0.74));
    cairo_fill_preserve(canvas.context());
    canvas.use(with_alpha(palette_.ink, 0.14));
    cairo_set_line_width(canvas.context(), 1);
    cairo_stroke(canvas.context());
    font.draw(canvas, before, side_px_, base_px_, palette_.ink);
    font.draw(canvas, after, number_px_ + number_px, base_px_, palette_.ink);
    canvas.finish();
    return plate;
}

std::string OverlayClock::text(double t) const {
    return fmt::format("{:.{}f}", std::max(t, 0.0), digits_);  // never "-0.00"
}

OverlayPainter::Rect OverlayClock::rect() const {
    const Plate& widest = plates_.back();
    return {widest.x, y_, widest.picture.width_px, height_px_};
}

void OverlayClock::draw(double t, Image& picture) const {
    const std::string number = text(t);
    const Plate& plate = plates_[std::min(number.size() - shortest_, plates_.size() - 1)];
    lay_over(plate.picture, plate.x, y_, picture);
    int x = plate.x + number_px_;
    for (const char c : number) {
        if (c == '.') {
            lay_over(point_, x, y_, picture);
        } else {
            lay_over(digit_[static_cast<std::size_t>(c - '0')], x, y_, picture);
        }
        x += c == '.' ? point_px_ : cell_px_;
    }
}

}  // namespace carom
