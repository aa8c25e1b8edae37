#include "render/draw2d/style.h"

#include <cairo.h>

namespace carom {

namespace {

double lightness(const Color& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

double saturation(const Color& c) {
    const double high = std::max({c.r, c.g, c.b}), low = std::min({c.r, c.g, c.b});
    return high > 0 ? (high - low) / high : 0;
}

}  // namespace

void draw_plate(Canvas& canvas, int width, int height, double radius, const Palette& palette,
                double opacity) {
    canvas.round_rect(0.5, 0.5, width - 1, height - 1, radius);
    canvas.use(with_alpha(palette.paper, opacity));
    cairo_fill_preserve(canvas.context());
    canvas.use(with_alpha(palette.ink, 0.14));
    cairo_set_line_width(canvas.context(), 1);
    cairo_stroke(canvas.context());
}

Ink trail_ink(const Look& look, Theme theme) {
    // A ball that is white in the main is known by its second colour, if that is one.
    Color color = look.color;
    constexpr double kGrey = 0.15;
    if (saturation(color) < kGrey && saturation(look.second_color) > kGrey)
        color = look.second_color;
    if (theme == Theme::kDark) {
        // Lightened as far as needed, by mixing in white.
        constexpr double kDarkest = 0.58;
        const double light = lightness(color);
        const double white = light < kDarkest ? (kDarkest - light) / (1 - light) : 0;
        return {color.r + white * (1 - color.r), color.g + white * (1 - color.g),
                color.b + white * (1 - color.b), 1};
    }
    // Darkened as far as needed, keeping the hue; grey gets a touch of the overlay's slate.
    constexpr double kLightest = 0.46;
    const double scale = std::min(1.0, kLightest / std::max(lightness(color), 1e-6));
    Ink ink{color.r * scale, color.g * scale, color.b * scale, 1};
    if (saturation(color) < kGrey) {
        ink.r = 0.5 * (ink.r + kSlate.r);
        ink.g = 0.5 * (ink.g + kSlate.g);
        ink.b = 0.5 * (ink.b + kSlate.b);
    }
    return ink;
}

Ink ghost_ink(Theme theme) {
    if (theme == Theme::kLight) return {0.263, 0.220, 0.792, 1};  // #4338ca
    return {0.702, 0.722, 0.992, 1};                              // #b3b8fd
}

std::string label_text(const std::string& name) {
    std::string text = name;
    std::replace(text.begin(), text.end(), '_', ' ');
    return text;
}

}  // namespace carom
