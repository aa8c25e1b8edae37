#include "sim/record/peaks.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/math/bracketed_root.h"

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

/// The highest turn of the gap from an impact to an instant; `piece` is where the look begins, and
/// becomes the last one looked at.
std::optional<Peak> highest(const Trajectory& ball, double radius, const Event& impact, double to,
                            std::size_t& piece) {
    const std::vector<Piece>& pieces = ball.pieces();
    std::optional<Peak> best;
    for (; piece < pieces.size() && pieces[piece].start < to; ++piece) {
        const Piece& p = pieces[piece];
        const double begin = std::max(p.start, impact.time);
        const double end = piece + 1 < pieces.size() ? std::min(pieces[piece + 1].start, to) : to;
        const std::optional<double> turn = turn_in(p, impact.normal, begin, end);
        if (!turn) continue;
        const double height = gap_at(p, impact, radius, *turn);
        if (height > 0 && (!best || height > best->height)) best = Peak{*turn, height};
    }
    if (piece > 0) --piece;  // the next impact may fall into it
    return best;
}

}  // namespace

std::vector<std::vector<Peak>> find_peaks(const Scene& scene, const Motion& motion) {
    struct Hop {
        const Event* impact = nullptr;  ///< the one that it began with
        std::size_t piece = 0;
    };
    std::vector<Hop> hops(scene.balls.size());
    std::vector<std::vector<Peak>> peaks(scene.balls.size());
    // What the gap did since the ball's last impact.
    const auto end_hop = [&](std::size_t ball, double to) {
        Hop& b = hops[ball];
        if (b.impact == nullptr || !b.impact->other.is_surface) return;
        if (!(b.impact->normal.dot(scene.simulation.gravity) < 0)) return;  // it faces up
        const auto& pieces = motion.balls[ball].pieces();
        while (b.piece + 1 < pieces.size() && pieces[b.piece + 1].start <= b.impact->time)
            ++b.piece;
        const auto peak =
            highest(motion.balls[ball], scene.balls[ball].radius, *b.impact, to, b.piece);
        if (peak) peaks[ball].push_back(*peak);
    };
    const auto meets = [&](int ball, const Event& impact) {
        const auto b = static_cast<std::size_t>(ball);
        end_hop(b, impact.time);
        hops[b].impact = &impact;
    };
    for (const Event& event : motion.events) {
        if (event.kind != EventKind::kImpact) continue;
        meets(event.ball, event);
        if (!event.other.is_surface) meets(event.other.index, event);
    }
    for (std::size_t b = 0; b < hops.size(); ++b) end_hop(b, motion.duration);
    return peaks;
}

}  // namespace carom
