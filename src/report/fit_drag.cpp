#include "report/fit_drag.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "report/fit_refusal.h"
#include "scene/air.h"

namespace carom {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// What is looked for: ln u_0, ln ε, and k = 1 / V^2 in units of `unit`.
struct Course {
    Vector3d at;
    double unit = 1, gravity = 9.81;

    double k() const { return at[2] * unit; }
};

/// arctan(x) + arsinh(x), over x; and u d/du less itself: both without cancellation near 0.
struct Shape {
    double value, steeper;
};
Shape shape(double x) {
    if (x < 1e-2) {
        const double s = x * x;  // 2 - x^2/2 + 11 x^4/40 - 0.1875 x^6
        return {2 - s / 2 + 11 * s * s / 40, -s + 1.1 * s * s};
    }
    const double value = (std::atan(x) + std::asinh(x)) / x;
    const double slope = 1 / (1 + x * x) + 1 / std::sqrt(1 + x * x);
    return {value, slope - value};
}

/// The intervals, and their changes with the three numbers.
void predict(const Course& course, std::size_t count, std::vector<double>& times,
             std::vector<Vector3d>& changes) {
    const double e = std::exp(course.at[1]), k = course.k();
    double u = std::exp(course.at[0]);
    Vector3d du(u, 0, 0);
    for (std::size_t n = 0; n < count; ++n) {
        const double x = u * std::sqrt(k), r = 1 + k * u * u, root = std::sqrt(r);
        const Shape s = shape(x);
        times.push_back(u * s.value / course.gravity);
        Vector3d change = du * (1 / r + 1 / root) / course.gravity;
        // dT/dk at one u: (u F'(x) - F / sqrt(k)) / (2 g k).
        const double over_k = k > 0 ? s.steeper / (2 * k) : -0.5 * u * u;
        change[2] += u * over_k / course.gravity * course.unit;
        changes.push_back(change);
        const double cubed = r * root;
        const double next = e * u / root;
        du *= e / cubed;
        du[1] += next;
        du[2] -= 0.5 * e * u * u * u / cubed * course.unit;
        u = next;
    }
}

struct Squares {
    double sum = 0;
    Matrix3d normal = Matrix3d::Zero();
    Vector3d gradient = Vector3d::Zero();
};

Squares squares(const Course& course, const std::vector<double>& measured) {
    std::vector<double> times;
    std::vector<Vector3d> changes;
    predict(course, measured.size(), times, changes);
    Squares result;
    for (std::size_t i = 0; i < measured.size(); ++i) {
        const double off = measured[i] - times[i];
        result.sum += off * off;
        result.normal += changes[i] * changes[i].transpose();
        result.gradient += changes[i] * off;
    }
    return result;
}

/// Levenberg's steps from a vacuum's guess. k stays at least 0.
Course least_squares(const std::vector<double>& measured, double gravity) {
    constexpr int kMostSteps = 500;
    Course course;
    course.gravity = gravity;
    const double u = 0.5 * gravity * measured.front();
    course.unit = 1 / (u * u);
    const double ratio = measured.back() / measured.front();
    course.at = {std::log(u), std::log(ratio) / static_cast<double>(measured.size() - 1), 0.05};
    Squares now = squares(course, measured);
    double damping = 1e-3;
    for (int i = 0; i < kMostSteps && damping < 1e12; ++i) {
        Matrix3d damped = now.normal;
        damped.diagonal() *= 1 + damping;
        const Vector3d step = damped.ldlt().solve(now.gradient);
        Course next = course;
        next.at += step;
        next.at[2] = std::max(next.at[2], 0.0);
        const Squares then = squares(next, measured);
        if (!(then.sum < now.sum)) {
            damping *= 10;
            continue;
        }
        course = next;
        now = then;
        damping = std::max(damping * 0.1, 1e-12);
        if (step.cwiseAbs().maxCoeff() < 1e-13) break;
    }
    return course;
}

void require_series(const std::vector<double>& intervals, bool reading_error) {
    const std::size_t least = reading_error ? 4 : 5;
    if (intervals.size() < least)
        refuse_fit(fmt::format(
            "--fit-drag: {} intervals do not tell restitution and drag apart; it takes "
            "at least {}{}, and better ten",
            intervals.size(), least, reading_error ? "" : " (4 with a --reading-error)"));
    for (std::size_t i = 0; i < intervals.size(); ++i)
        if (!(intervals[i] > 0))
            refuse_fit(fmt::format("interval {}: {} s; it must be above 0", i + 1, intervals[i]));
    if (!(intervals.back() < intervals.front()))
        refuse_fit("the intervals grow; those of a bouncing ball shrink");
}

}  // namespace

DragFit fit_drag(const std::vector<double>& intervals, const DragBall& ball,
                 const std::optional<double>& reading_error) {
    require_series(intervals, reading_error.has_value());
    double gravity = ball.gravity;
    if (ball.air.buoyancy) gravity *= 1 - buoyant_part(ball.air, ball.radius, ball.mass);
    if (!(gravity > 0)) refuse_fit("the ball is lighter than the air that it displaces");
    const Course course = least_squares(intervals, gravity);
    const Squares end = squares(course, intervals);

    const int degrees = static_cast<int>(intervals.size()) - 3;
    double variance = reading_error ? *reading_error * *reading_error : 0;
    double covered = kNormal95;
    if (const double scatter = end.sum / degrees; scatter > variance) {
        variance = scatter;
        covered = student_t95(degrees);
    }
    const Matrix3d covariance = end.normal.inverse() * variance;
    const auto estimate = [&](double value, double error) {
        return Interval95{value, error, value - covered * error, value + covered * error};
    };
    DragFit fit;
    const double e = std::exp(course.at[1]);
    fit.restitution = estimate(e, e * std::sqrt(covariance(1, 1)));
    // C_D = 2 m g / (rho A) k.
    const double area = std::numbers::pi * ball.radius * ball.radius;
    const double per_k = 2 * ball.mass * gravity / (ball.air.density * area) * course.unit;
    fit.drag = estimate(per_k * course.at[2], per_k * std::sqrt(covariance(2, 2)));
    fit.density = ball.air.density;
    fit.terminal = 1 / std::sqrt(course.k());
    fit.first_speed = std::exp(course.at[0]);
    fit.residual_s = std::sqrt(end.sum / degrees);
    constexpr double kCarried = 0.5;
    if (!(fit.drag.high - fit.drag.value < kCarried * fit.drag.value))
        refuse_fit(fmt::format(
            "--fit-drag: these intervals do not tell the drag: C_D = {:.2g} ± {:.2g} at "
            "95 %. It shows in fast bounces of a light ball: drop it from higher, "
            "take more bounces or read them finer; or give --drag and leave this out",
            fit.drag.value, fit.drag.high - fit.drag.value));
    if (!(fit.restitution.value <= 1))
        refuse_fit(
            fmt::format("a coefficient of {:.4g}: in this air the ball would have to gain energy",
                        fit.restitution.value));
    return fit;
}

namespace {

std::string drag_snippet(const DragFit& fit, const std::string& name) {
    return fmt::format(
        "air: {{density: {}}}\nmaterials:\n  {}: {{restitution: {:.8g}}}\ndefaults: {{ball: "
        "{{drag: "
        "{:.6g}}}}}\n",
        fit.density, name, fit.restitution.value, fit.drag.value);
}

}  // namespace

std::string drag_fit_text(const DragFit& fit, const std::string& name) {
    const auto line = [](const char* what, const Interval95& found) {
        return fmt::format("# {} {:.6f} ± {:.2g} (standard uncertainty); 95 %: {:.6f} ... {:.6f}\n",
                           what, found.value, found.uncertainty, found.low, found.high);
    };
    return line("restitution ε =", fit.restitution) + line("drag C_D =", fit.drag) +
           fmt::format(
               "# terminal speed {:.6g} m/s; first rebound with {:.6g} m/s; scatter {:.2g} s\n",
               fit.terminal, fit.first_speed, fit.residual_s) +
           drag_snippet(fit, name);
}

std::string drag_fit_json(const DragFit& fit, const std::string& name) {
    const auto object = [](const Interval95& found) {
        return nlohmann::ordered_json{{"value", found.value},
                                      {"uncertainty", found.uncertainty},
                                      {"interval_95", {found.low, found.high}}};
    };
    nlohmann::ordered_json json;
    json["restitution"] = object(fit.restitution);
    json["drag"] = object(fit.drag);
    json["terminal_speed_m_s"] = fit.terminal;
    json["first_speed_m_s"] = fit.first_speed;
    json["scatter_s"] = fit.residual_s;
    json["material"] = name;
    json["snippet"] = drag_snippet(fit, name);
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace carom
