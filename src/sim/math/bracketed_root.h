// The root of a function between two places where its signs differ.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

/// f(above) >= 0 > f(below); the answer lies between them, right to the last digits. Inverse
/// quadratic interpolation where it is safe, else bisection (T. R. Chandrupatla, "A new hybrid
/// quadratic/bisection algorithm for finding the zero of a nonlinear function without using
/// derivatives", Advances in Engineering Software 28, 1997).
template <class F>
double bracketed_root(F&& f, double above, double below) {
    constexpr int kMostIterations = 120;  // bisection alone needs 64
    double a = below, b = above, c = below;
    double f_a = f(a), f_b = f(b), f_c = f_a;
    if ((f_a < 0) == (f_b < 0)) return below;  // rounding has moved the root to the border
    double t = 0.5, best = b;
    double reach = 1;  // where rounding hides the sign, ever larger steps look for its change
    for (int i = 0; i < kMostIterations; ++i) {
        const double x = a + t * (b - a);
        const double f_x = f(x);
        if ((f_x < 0) == (f_a < 0)) {
            c = a;
            f_c = f_a;
        } else {
            c = b;
            b = a;
            f_c = f_b;
            f_b = f_a;
        }
        a = x;
        f_a = f_x;
        best = std::abs(f_a) < std::abs(f_b) ? a : b;
        const double width = std::abs(b - a);
        const double rounding = std::numeric_limits<double>::epsilon() * std::abs(best);
        if (f_x == 0 || width <= 2 * rounding || width == 0) return best;
        const double xi = (a - b) / (c - b), phi = (f_a - f_b) / (f_c - f_b);
        const bool safe = phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi;
        t = safe ? f_a / (f_b - f_a) * f_c / (f_b - f_c) +
                       (c - a) / (b - a) * f_a / (f_c - f_a) * f_b / (f_c - f_b)
                 : 0.5;
        const double least = std::min(0.5, reach * rounding / width);
        reach = t < least || t > 1 - least ? 2 * reach : 1;
        t = std::min(std::max(t, least), 1 - least);
    }
    return best;
}

}  // namespace carom
