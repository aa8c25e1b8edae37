#include "sim/peaks.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/bracketed_root.h"

namespace carom {

namespace {

/// A gap of this fraction of a place is its rounding.
constexpr double kTouching = 1e-14;

/// The time of the turn inside a piece, where n . v(t) = 0 on its way down.
std::optional<double> turn_in(const Piece& piece, const Vec3& normal, double from, double to) {
    if (piece.curve) {
        const auto rising = [&](double t) { return normal.dot(piece.velocity_at(t)); };
        if (!(rising(from) > 0 && rising(to) < 0)) return std::nullopt;
        return bracketed_root(rising, from, to);
    }
    const double a = normal.dot(piece.acceleration);
    if (!(a < 0)) return std::nullopt;
    const double t = piece.start - normal.dot(piece.velocity) / a;
    if (!(t > from && t < to)) return std::nullopt;
    return t;
}

/// The gap under a ball at its turn. A piece that starts on the impact itself has no gap then: what
/// it gains is v^2 / (2 g_n), without the rounding of the place that a small hop would drown in.
double gap_at(const Piece& piece, const Event& impact, double radius, double turn) {
    const auto gap = [&](const Vec3& x) { return impact.normal.dot(x - impact.point) - radius; };
    const double scale = piece.position.cwiseAbs().maxCoeff() + radius;
    if (!piece.curve && piece.start == impact.time &&
        std::abs(gap(piece.position)) <= kTouching * scale) {
        const double v = impact.normal.dot(piece.velocity);
        return v * v / (-2 * impact.normal.dot(piece.acceleration));
    }
    return gap(piece.position_at(turn));
}

/// The highest turn of the gap between two instants.
std::optional<Peak> highest(const Trajectory& ball, double radius, const Event& impact, double to) {
    const std::vector<Piece>& pieces = ball.pieces();
    std::optional<Peak> best;
    for (std::size_t i = ball.piece_index(impact.time); i < pieces.size(); ++i) {
        if (pieces[i].start >= to) break;
        const double begin = std::max(pieces[i].start, impact.time);
        const double end = i + 1 < pieces.size() ? std::min(pieces[i + 1].start, to) : to;
        const std::optional<double> turn = turn_in(pieces[i], impact.normal, begin, end);
        if (!turn) continue;
        const double height = gap_at(pieces[i], impact, radius, *turn);
        if (height > 0 && (!best || height > best->height)) best = Peak{*turn, height};
    }
    return best;
}

}  // namespace

std::vector<std::vector<Peak>> find_peaks(const Scene& scene, const Motion& motion) {
    std::vector<std::vector<const Event*>> impacts(scene.balls.size());
    for (const Event& event : motion.events) {
        if (event.kind != EventKind::kImpact) continue;
        impacts[static_cast<std::size_t>(event.ball)].push_back(&event);
        if (!event.other.is_surface)
            impacts[static_cast<std::size_t>(event.other.index)].push_back(&event);
    }

    std::vector<std::vector<Peak>> peaks(scene.balls.size());
    for (std::size_t b = 0; b < scene.balls.size(); ++b) {
        for (std::size_t i = 0; i < impacts[b].size(); ++i) {
            const Event& impact = *impacts[b][i];
            const bool faces_up = impact.normal.dot(scene.simulation.gravity) < 0;
            if (!impact.other.is_surface || !faces_up) continue;
            const double to = i + 1 < impacts[b].size() ? impacts[b][i + 1]->time : motion.duration;
            const auto peak = highest(motion.balls[b], scene.balls[b].radius, impact, to);
            if (peak) peaks[b].push_back(*peak);
        }
    }
    return peaks;
}

}  // namespace carom
