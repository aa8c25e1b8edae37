#include "render/trail_curve.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace carom {

TrailCurve::TrailCurve(const Trajectory& trajectory, const View& view, double duration)
    : trajectory_(&trajectory), view_(&view), duration_(duration) {
    CAROM_CHECK(trajectory.pieces().size(), >, 0u);
    steps_ = steps_of_piece(0);
}

double TrailCurve::end_of_piece(std::size_t piece) const {
    const auto& pieces = trajectory_->pieces();
    return piece + 1 < pieces.size() ? std::min(pieces[piece + 1].start, duration_) : duration_;
}

std::size_t TrailCurve::steps_of_piece(std::size_t index) const {
    const Piece& piece = trajectory_->pieces()[index];
    const double length = end_of_piece(index) - piece.start;
    if (!(length > 0)) return 1;
    const BallState begin = piece.at(piece.start), end = piece.at(piece.start + length);
    // Depth and speed are convex or monotonic enough for their bounds to lie at the ends, except a
    // depth that turns in between: there the path dips by at most |a| length^2 / 8.
    const double acceleration = piece.largest_acceleration();
    const double dip = acceleration * length * length / 8;
    const auto depth = [&](const Vec3& p) { return (p - view_->eye()).dot(view_->forward()); };
    const double far = std::max(depth(begin.position), depth(end.position));
    if (far + dip <= 0) return 1;
    // Passing the camera closely is not worth more corners than this.
    const double near =
        std::max(std::min(depth(begin.position), depth(end.position)) - dip, 0.02 * (far + dip));
    // A length across the view axis is magnified by 1 / depth, and by slant towards the corners.
    const double aspect = static_cast<double>(view_->width_px()) / view_->height_px();
    const double slant = 1 + view_->tan_half_fov_y() * std::hypot(1, aspect);
    const double px_per_m = slant * view_->pixels_per_metre(near);
    // A chord over the time h leaves a parabola by |a| h^2 / 8.
    const double curved = length * std::sqrt(acceleration * px_per_m / (8 * kChordError));
    const double speed = std::max(begin.velocity.norm(), end.velocity.norm());
    const double steps = std::max(curved, speed * length * px_per_m / kLongestStep);
    constexpr double kMost = 4096;
    return static_cast<std::size_t>(std::clamp(std::ceil(steps), 1.0, kMost));
}

TrailPoint TrailCurve::at(double t) const {
    const View::Projected p = view_->project(trajectory_->at(t).position);
    const bool visible = p.depth_m > 0 && std::isfinite(p.x_px) && std::isfinite(p.y_px);
    return {t, visible ? Vec2(p.x_px, p.y_px) : Vec2(0, 0), visible};
}

std::optional<TrailPoint> TrailCurve::next(double limit) {
    const auto& pieces = trajectory_->pieces();
    while (piece_ < pieces.size()) {
        const double start = pieces[piece_].start, end = end_of_piece(piece_);
        const double time =
            start + (end - start) * static_cast<double>(step_) / static_cast<double>(steps_);
        if (time > limit) return std::nullopt;
        if (++step_ >= steps_) {
            step_ = 0;
            if (++piece_ < pieces.size()) steps_ = steps_of_piece(piece_);
        }
        const TrailPoint point = at(time);
        const bool same =
            last_ && last_->visible == point.visible && (last_->px - point.px).norm() < kLeastStep;
        if (same) continue;
        last_ = point;
        return point;
    }
    return std::nullopt;
}

}  // namespace carom
