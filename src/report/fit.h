// The paper's graphical method as a tool: from measured drops to a coefficient of restitution with
// its uncertainty, and to the line of virtual bodies (x, v) that have it (Khurelbaatar et al. 2012,
// Eq. 7, 9 and 10).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/fall_in_air.h"
#include "report/measurement.h"
#include "report/plot.h"
#include "scene/scene.h"

namespace carom {

/// Which point of the ball a rebound was measured to. A drop is always measured from its bottom.
enum class ReboundTo { kBottom, kTop };

struct FitOptions {
    ReboundTo rebound_to = ReboundTo::kBottom;
    double diameter_m = 0;  ///< of the ball; only for kTop
    /// Standard uncertainty of one reading: of a height, m, or of an interval, s.
    std::optional<double> reading_error;
    std::optional<FallInAir> air;  ///< empty: a vacuum
};

/// Uncertainties after the Guide to the Expression of Uncertainty in Measurement (JCGM 100:2008).
struct RestitutionFit {
    double restitution = 0;
    std::vector<double> single;          ///< of each drop, or of each pair of intervals
    std::optional<double> from_repeats;  ///< standard uncertainty, type A: the scatter of repeats
    std::optional<double> from_reading;  ///< the same, type B: from the reading error
    /// The larger of the two: scatter has the reading errors in it, but a few repeats may agree by
    /// chance. Empty where there is neither.
    std::optional<double> uncertainty;
    /// 95 %: the uncertainty times Student's t (of the repeats) or 1.96; not above 1.
    std::optional<double> low, high;
};

/// Drops: the mean of sqrt(rebound / drop), bottom to bottom. Intervals: the slope of their
/// logarithms, ln t_n = ln t_0 + n ln ε (of two, t_1 / t_0). In air the closed forms of FallInAir
/// take the place of both: heights give speeds of impact and rebound, intervals the speeds u_n, of
/// which the part p_n is left at the next impact, ln u_n = ln u_0 + n ln ε + sum ln p_i, i < n.
/// Throws Failure(kInput) for heights and times that no bouncing ball has.
RestitutionFit fit_restitution(const Measurements& measured, const FitOptions& options);

/// t with P(|T| < t) = 0.95 for Student's distribution. `degrees` >= 1.
double student_t95(int degrees);

/// The line of virtual bodies with one coefficient, x / v = -2 ln ε / K, and a point on it.
struct VirtualBodyLine {
    double constant = 4;  ///< K, 1/s
    double ratio_s = 0;   ///< x / v
    VirtualBody point;
};
/// `velocity` > 0 chooses the point.
VirtualBodyLine virtual_body_line(double restitution, double constant, double velocity);

/// A scene's lines for this material; the keys are the whole file's, to be pasted at its margin.
std::string material_snippet(const std::string& name, const VirtualBodyLine& line);

/// The whole result for people, as YAML: the snippet below lines of comment.
std::string fit_text(const RestitutionFit& fit, const VirtualBodyLine& line,
                     const std::string& name);
/// The same for programs.
std::string fit_json(const RestitutionFit& fit, const VirtualBodyLine& line,
                     const std::string& name);

/// The plot of Figure 7 for this ball: the line, the band of 95 %, the point.
Plot fit_plot(const RestitutionFit& fit, const VirtualBodyLine& line);

}  // namespace carom
