// A smooth curve through measured points that never overshoots them.
#pragma once

#include <vector>

namespace carom {

/// Cubic Hermite interpolation whose slopes keep it monotone wherever the points are; constant
/// beyond the first and the last point (F. N. Fritsch, J. Butland, "A method for constructing local
/// monotone piecewise cubic interpolants", SIAM J. Sci. Stat. Comput. 5, 1984).
class MonotoneCurve {
  public:
    /// The value 0 everywhere.
    MonotoneCurve() : MonotoneCurve({0}, {0}) {}
    /// `x` increases; as many `y`, at least one.
    MonotoneCurve(std::vector<double> x, std::vector<double> y);

    double at(double x) const;
    /// dy/dx.
    double slope_at(double x) const;
    const std::vector<double>& x() const { return x_; }
    const std::vector<double>& y() const { return y_; }

  private:
    std::vector<double> x_, y_, slope_;
};

}  // namespace carom
