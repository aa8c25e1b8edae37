#include "sim/math/hermite_fit.h"

#include <array>

namespace carom {

Curve::Terms curve_through(const CurveNode& begin, const CurveNode& middle, const CurveNode& end,
                           double h) {
    constexpr std::array<std::array<double, 6>, 6> kInverse = {
        {{256, -32, 8, -58, 10, -0.5},
         {-1536, 160, -56, 453, -79, 4},
         {3840, -288, 152, -1374, 243, -12.5},
         {-4864, 224, -200, 2012, -362, 19},
         {3072, -64, 128, -1416, 260, -14},
         {-768, 0, -32, 384, -72, 4}}};
    const auto rest = [&](const CurveNode& node, double u) -> std::array<Vec3, 3> {
        const double s = u * h;
        return {node.value - begin.value - s * (begin.rate + (0.5 * s) * begin.second),
                h * (node.rate - begin.rate - s * begin.second),
                (h * h) * (node.second - begin.second)};
    };
    const std::array<Vec3, 3> at_middle = rest(middle, 0.5), at_end = rest(end, 1);
    Curve::Terms terms;
    for (std::size_t i = 0; i < 6; ++i) {
        terms[i] = Vec3::Zero();
        for (std::size_t k = 0; k < 3; ++k)
            terms[i] += kInverse[i][k] * at_middle[k] + kInverse[i][k + 3] * at_end[k];
    }
    return terms;
}

}  // namespace carom
