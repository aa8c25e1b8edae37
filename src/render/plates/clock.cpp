#include "render/plates/clock.h"

#include <fmt/format.h>

#include <cmath>

#include "render/draw2d/style.h"

namespace carom {

namespace {

constexpr double kClockPx = 17;  // letters, at 720
constexpr const char* kBefore = "t = ";
constexpr const char* kAfter = " s";

}  // namespace

ClockElement::ClockElement(const ClockOptions& options, double longest_s, int width_px,
                           int height_px, const Palette& palette)
    : palette_(palette), digits_(options.digits), picture_width_px_(width_px) {
    const Font font(letters_px(kClockPx, height_px));
    const double size = font.size_px();
    const Corner corner = options.corner;
    at_left_ = corner == Corner::kTopLeft || corner == Corner::kBottomLeft;
    const bool at_top = corner == Corner::kTopLeft || corner == Corner::kTopRight;
    border_px_ = border_px(height_px);
    side_px_ = whole_px(0.62 * size);
    height_px_ = whole_px(1.75 * size);
    y_ = at_top ? border_px_ : height_px - border_px_ - height_px_;
    // On a whole row, so that digits stay sharp.
    base_px_ = std::round(0.5 * (height_px_ + font.cap_height_px()));

    const TextRun point = font.lay_out(".");
    number_px_ = side_px_ + whole_px(font.lay_out(kBefore).width_px);
    cell_px_ = static_cast<int>(std::lround(font.digit_width_px()));
    point_px_ = whole_px(point.width_px);
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

ClockElement::Plate ClockElement::make_plate(const Font& font, int number_px) const {
    const TextRun before = font.lay_out(kBefore), after = font.lay_out(kAfter);
    const int width = number_px_ + number_px + whole_px(after.width_px) + side_px_;
    Plate plate{at_left_ ? border_px_ : picture_width_px_ - border_px_ - width,
                Image(width, height_px_)};
    Canvas canvas(plate.picture);
    draw_plate(canvas, width, height_px_, 0.36 * font.size_px(), palette_, 0.74);
    font.draw(canvas, before, side_px_, base_px_, palette_.ink);
    font.draw(canvas, after, number_px_ + number_px, base_px_, palette_.ink);
    canvas.finish();
    return plate;
}

std::string ClockElement::text(double t) const {
    return fmt::format("{:.{}f}", std::max(t, 0.0), digits_);  // never "-0.00"
}

PixelRect ClockElement::rect() const {
    const Plate& widest = plates_.back();
    return PixelRect::at(widest.x, y_, widest.picture.width_px, height_px_);
}

Appearance ClockElement::appearance(double t) {
    const std::string number = text(t);
    const Plate& plate = plate_for(number);
    return {{PixelRect::at(plate.x, y_, plate.picture.width_px, height_px_)},
            {number.begin(), number.end()}};
}

void ClockElement::draw(double t, Image& picture) {
    const std::string number = text(t);
    const Plate& plate = plate_for(number);
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

ElementKind clock_kind() {
    ElementKind kind;
    kind.keeps_place = true;
    kind.name = "clock";
    kind.repeat = Repeat::kOncePerFilm;
    kind.wanted = [](const Scene& scene) { return scene.overlay.clock.has_value(); };
    kind.make = [](const ElementContext& context) -> std::unique_ptr<Element> {
        return std::make_unique<ClockElement>(*context.scene.overlay.clock, context.motion.duration,
                                              context.view.width_px(), context.view.height_px(),
                                              context.palette);
    };
    return kind;
}

}  // namespace carom
