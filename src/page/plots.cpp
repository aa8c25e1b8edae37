#include "page/plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/markup.h"
#include "page/plot_frame.h"

namespace carom {

namespace {

constexpr double kFine = 1.5;  // px: what is shorter is drawn as a line

/// Upwards: against gravity; along z without any.
Vec3 up_of(const Scene& scene) {
    const double g = scene.simulation.gravity.norm();
    return g > 0 ? Vec3(-scene.simulation.gravity / g) : Vec3(Vec3::UnitZ());
}

/// Of a plot over time, with 0 in it.
PlotFrame frame_of(double duration_s, double least, double most) {
    PlotFrame frame;
    frame.end = duration_s > 0 ? duration_s : 1;
    frame.low = std::min(0.0, least);
    frame.high = most > frame.low ? most : frame.low + 1;
    frame.high += 0.04 * (frame.high - frame.low);
    return frame;
}

/// Points of a curve, one decimal each.
class Path {
  public:
    explicit Path(const PlotFrame& frame) : frame_(frame) {}
    void move(double t, double value) { put("M", t, value); }
    /// Nothing where it is too near to see.
    void line(double t, double value) {
        if (std::hypot(frame_.x(t) - x_, frame_.y(value) - y_) >= 0.5) put("L", t, value);
    }
    void parabola(double t_control, double control, double t, double value) {
        text_ += fmt::format("Q{:.1f} {:.1f}", frame_.x(t_control), frame_.y(control));
        put(" ", t, value);
    }
    std::string element(std::size_t color, std::size_t dash) const {
        return fmt::format("<path class=\"curve s{} d{}\" d=\"{}\"/>\n", color, dash, text_);
    }

  private:
    void put(const char* command, double t, double value) {
        x_ = frame_.x(t);
        y_ = frame_.y(value);
        text_ += fmt::format("{}{:.1f} {:.1f}", command, x_, y_);
    }

    const PlotFrame& frame_;
    std::string text_;
    double x_ = 0, y_ = 0;
};

struct PageCurve {
    std::string name;
    std::string path;
    std::size_t color = 0, dash = 0;
};

std::string plot(const PlotFrame& frame, const char* unit, const std::string& label,
                 const std::vector<PageCurve>& curves) {
    std::string text = fmt::format(
        "<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\" data-left=\"{}\" "
        "data-right=\"{}\" data-end=\"{}\">\n{}",
        PlotFrame::kWidth, PlotFrame::kHeight, escaped(label), PlotFrame::kLeft, PlotFrame::kRight,
        frame.end, frame.axes("time, s", unit));
    for (const PageCurve& curve : curves) text += curve.path;
    text += fmt::format(
        "<line class=\"cursor\" visibility=\"hidden\" x1=\"{0}\" x2=\"{0}\" y1=\"{1}\" "
        "y2=\"{2}\"/>\n</svg>\n<ul class=\"key\">\n",
        PlotFrame::kLeft, PlotFrame::kTop, PlotFrame::kBottom);
    for (const PageCurve& curve : curves)
        text += fmt::format(
            "<li><svg viewBox=\"0 0 32 10\" aria-hidden=\"true\"><path class=\"curve s{} d{}\" "
            "d=\"M0 5H32\"/></svg>{}</li>\n",
            curve.color, curve.dash, escaped(curve.name));
    return text + "</ul>\n";
}

/// The height of one ball over time.
class HeightCurve {
  public:
    HeightCurve(const Trajectory& path, const Vec3& up, double radius, double end_s)
        : pieces_(path.pieces()), up_(up), radius_(radius), end_s_(end_s) {}

    double end_of(std::size_t i) const {
        return i + 1 < pieces_.size() ? pieces_[i + 1].start : end_s_;
    }
    double at(std::size_t i, double t) const {
        return up_.dot(pieces_[i].position_at(t)) - radius_;
    }
    void extend(double& least, double& most) const {
        for (std::size_t i = 0; i < pieces_.size(); ++i) {
            const Piece& piece = pieces_[i];
            const double speed = up_.dot(piece.velocity), pull = up_.dot(piece.acceleration);
            const double top = pull < 0 ? piece.start - speed / pull : piece.start;
            for (const double t :
                 {piece.start, std::clamp(top, piece.start, end_of(i)), end_of(i)}) {
                least = std::min(least, at(i, t));
                most = std::max(most, at(i, t));
            }
        }
    }
    std::string drawn(const PlotFrame& frame, std::size_t color, std::size_t dash) const {
        Path path(frame);
        path.move(0, at(0, 0));
        for (std::size_t i = 0; i < pieces_.size(); ++i) add(i, frame, path);
        return path.element(color, dash);
    }

  private:
    void add(std::size_t i, const PlotFrame& frame, Path& path) const {
        const Piece& piece = pieces_[i];
        const double seconds = end_of(i) - piece.start;
        if (frame.x(end_of(i)) - frame.x(piece.start) < kFine) {
            path.line(end_of(i), at(i, end_of(i)));
        } else if (piece.curve) {
            constexpr int kParts = 12;
            for (int k = 1; k <= kParts; ++k) {
                const double t = piece.start + seconds * k / kParts;
                path.line(t, at(i, t));
            }
        } else {  // a parabola is a Bezier curve whose control point lies on both tangents
            path.parabola(piece.start + 0.5 * seconds,
                          at(i, piece.start) + 0.5 * seconds * up_.dot(piece.velocity), end_of(i),
                          at(i, end_of(i)));
        }
    }

    const std::vector<Piece>& pieces_;
    Vec3 up_;
    double radius_, end_s_;
};

constexpr std::size_t kColors = 7;

}  // namespace

std::string height_plot(const Scene& scene, const Motion& motion) {
    const Vec3 up = up_of(scene);
    std::vector<HeightCurve> heights;
    double least = 0, most = 0;
    for (std::size_t i = 0; i < std::min(kMostCurves, motion.balls.size()); ++i) {
        heights.emplace_back(motion.balls[i], up, scene.balls[i].radius, motion.duration);
        heights.back().extend(least, most);
    }
    const PlotFrame frame = frame_of(motion.duration, least, most);
    std::vector<PageCurve> curves;
    for (std::size_t i = 0; i < heights.size(); ++i)
        curves.push_back({motion.ball_names[i], heights[i].drawn(frame, i % kColors, i / kColors),
                          i % kColors, i / kColors});
    return plot(frame, "m",
                fmt::format("Heights of the balls' lowest points over {:.6g} s, up to {:.4g} m",
                            motion.duration, most),
                curves);
}

std::string energy_plot(const Scene& scene, const Motion& motion) {
    constexpr int kInstants = 600;
    const Vec3 up = up_of(scene);
    const double g = scene.simulation.gravity.norm();
    std::array<std::vector<double>, 3> energy;  // all, kinetic, potential
    double least = 0, most = 0;
    for (int k = 0; k <= kInstants; ++k) {
        const double t = motion.duration * k / kInstants;
        double kinetic = 0, potential = 0;
        for (std::size_t i = 0; i < motion.balls.size(); ++i) {
            const Ball& ball = scene.balls[i];
            const BallState state = motion.balls[i].at(t);
            const double inertia = ball.inertia_factor * ball.radius * ball.radius;
            kinetic += 0.5 * ball.mass *
                       (state.velocity.squaredNorm() + inertia * state.spin.squaredNorm());
            potential += ball.mass * g * (up.dot(state.position) - ball.radius);
        }
        const std::array<double, 3> values = {kinetic + potential, kinetic, potential};
        for (std::size_t i = 0; i < values.size(); ++i) {
            energy[i].push_back(values[i]);
            least = std::min(least, values[i]);
            most = std::max(most, values[i]);
        }
    }
    const PlotFrame frame = frame_of(motion.duration, least, most);
    constexpr std::array<const char*, 3> kNames = {"sum", "kinetic energy", "potential energy"};
    std::vector<PageCurve> curves;
    for (std::size_t i = 0; i < kNames.size(); ++i) {
        Path path(frame);
        path.move(0, energy[i][0]);
        for (int k = 1; k <= kInstants; ++k)
            path.line(motion.duration * k / kInstants, energy[i][static_cast<std::size_t>(k)]);
        curves.push_back({kNames.at(i), path.element(i, 0), i, 0});
    }
    return plot(
        frame, "J",
        fmt::format("Energy of all balls over {:.6g} s: {:.4g} J at first, {:.4g} J at last",
                    motion.duration, energy[0].front(), energy[0].back()),
        curves);
}

}  // namespace carom
