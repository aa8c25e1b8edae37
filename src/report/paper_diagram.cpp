// The idea of Figures 1-3 as a diagram; declared in paper_figures.h.
#include <array>

#include "report/paper_figures.h"

namespace carom {

namespace {

constexpr int kBodyA = 0, kBodyB = 1, kMeasure = 5;  // of the palette
constexpr double kRadius = 1.0;
constexpr double kInnerA = 0.45, kInnerB = 0.6;  // x_A = 0.55, x_B = 0.4 radii

/// Real bodies, outlines; virtual ones, discs that reach `reach` beyond their places at rest.
void add_bodies(Plot& plot, double left, double right, double reach_a, double reach_b) {
    plot.circles.push_back({.x = left, .radius = kRadius, .color = kBodyA});
    plot.circles.push_back({.x = right, .radius = kRadius, .color = kBodyB});
    plot.circles.push_back(
        {.x = left + reach_a, .radius = kInnerA, .color = kBodyA, .dashed = true, .fill = 0.12});
    plot.circles.push_back(
        {.x = right - reach_b, .radius = kInnerB, .color = kBodyB, .dashed = true, .fill = 0.12});
}

void add_caption(Plot& plot, double x, const char* first, const char* second) {
    plot.texts.push_back({x, -1.55, first, true});
    plot.texts.push_back({x, -1.85, second, true});
}

}  // namespace

Figure virtual_body_diagram() {
    Plot plot;
    plot.title = "Figures 1-3: real bodies and their virtual bodies";
    plot.diagram = true;
    plot.width_px = 1100;
    plot.height_px = 330;
    plot.x = {.label = "", .min = -2.7, .max = 13.0};
    plot.y = {.label = "", .min = -2.05, .max = 1.75};

    // Before: each virtual body rests a distance x below the surface.
    add_bodies(plot, -1.25, 1.25, 0, 0);
    plot.arrows.push_back({-2.3, 1.25, -1.3, 1.25, kBodyA});
    plot.arrows.push_back({2.3, 1.25, 1.3, 1.25, kBodyB});
    plot.texts.push_back({-2.3, 1.5, "A_{1}"});
    plot.texts.push_back({2.0, 1.5, "B_{1}"});
    plot.texts.push_back({-1.25, 0, "A_{2}", true});
    plot.texts.push_back({1.25, 0, "B_{2}", true});
    plot.arrows.push_back({-1.25 + kInnerA, 0, -1.25 + kRadius, 0, kMeasure, true});
    plot.texts.push_back({-1.25 + 0.5 * (kInnerA + kRadius), 0.25, "x_{A}", true});
    plot.arrows.push_back({1.25 - kRadius, 0, 1.25 - kInnerB, 0, kMeasure, true});
    plot.texts.push_back({1.25 - 0.5 * (kInnerB + kRadius), 0.25, "x_{B}", true});
    add_caption(plot, 0, "before: the virtual surfaces lie", "x below the real ones");

    // At contact: the virtual bodies set out towards the contact point C_1.
    constexpr double kMiddle = 5.1;
    add_bodies(plot, kMiddle - kRadius, kMiddle + kRadius, 0, 0);
    plot.arrows.push_back({kMiddle - 1.0, 0, kMiddle - 0.35, 0, kBodyA});
    plot.arrows.push_back({kMiddle + 1.0, 0, kMiddle + 0.3, 0, kBodyB});
    plot.texts.push_back({kMiddle - 1.15, 0.24, "v_{A}"});
    plot.texts.push_back({kMiddle + 0.9, 0.24, "v_{B}"});
    plot.circles.push_back({.x = kMiddle, .radius = 0.05, .color = kMeasure, .fill = 1});
    plot.texts.push_back({kMiddle, 1.25, "C_{1}", true});
    plot.arrows.push_back({kMiddle, 1.05, kMiddle, 0.12, kMeasure});
    add_caption(plot, kMiddle, "at contact: both set out", "for the contact point");

    // After T: the virtual surfaces meet. A's arrived first and went on into B at B's speed.
    constexpr double kLast = 10.3, kInto = 0.09;
    add_bodies(plot, kLast - kRadius, kLast + kRadius, kRadius - kInnerA + kInto,
               kRadius - kInnerB - kInto);
    plot.circles.push_back({.x = kLast + kInto, .radius = 0.05, .color = kMeasure, .fill = 1});
    plot.texts.push_back({kLast + kInto, 1.25, "C_{2}", true});
    plot.arrows.push_back({kLast + kInto, 1.05, kLast + kInto, 0.12, kMeasure});
    add_caption(plot, kLast, "after T = x_{A}/(2v_{A}) + x_{B}/(2v_{B}) they meet;",
                "the bodies part with ε = exp(−K T)");
    return {plot, {}};
}

}  // namespace carom
