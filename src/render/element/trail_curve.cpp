#include "render/element/trail_curve.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace carom {

namespace {

/// So that about kManyPieces are shown at once.
std::size_t stride_for(const Trajectory& trajectory, double duration, double shown_s) {
    if (!(duration > 0)) return 1;
    const double shown =
        static_cast<double>(trajectory.pieces().size()) * std::min(1.0, shown_s / duration);
    return static_cast<std::size_t>(shown) / TrailCurve::kManyPieces + 1;
}

}  // namespace

TrailCurve::TrailCurve(const Trajectory& trajectory, const View& view, double duration,
                       double shown_s)
    : trajectory_(&trajectory),
      view_(&view),
      duration_(duration),
      stride_(stride_for(trajectory, duration, shown_s)) {
    CAROM_CHECK(trajectory.pieces().size(), >, 0u);
    steps_ = steps_of_piece(0);
}

/// Short pieces, as steps are, cost no more than one corner and make up a path together.
bool TrailCurve::is_left_out() const {
    return stride_ > 1 && step_ == 0 && steps_ > 1 && piece_ % stride_ != 0;
}

void TrailCurve::skip_to(double t) {
    const std::size_t piece = trajectory_->piece_index(t);
    if (piece < piece_ + kManyPieces) return;
    piece_ = piece;
    step_ = 0;
    steps_ = steps_of_piece(piece_);
    last_.reset();
    pen_up_ = false;
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
        if (is_left_out()) {
            if (++piece_ < pieces.size()) steps_ = steps_of_piece(piece_);
            if (pen_up_ || !last_) continue;
            pen_up_ = true;
            return last_ = at(time);  // the end of what is handed out
        }
        if (pen_up_) {
            pen_up_ = false;
            return last_ = TrailPoint{time, Vec2(0, 0), false};
        }
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
