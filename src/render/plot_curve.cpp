#include "render/plot_curve.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace carom {

PlotCurve::PlotCurve(const Trajectory& trajectory, double below_m, const PlotScale& scale,
                     double duration)
    : trajectory_(&trajectory), below_m_(below_m), scale_(scale), duration_(duration) {
    CAROM_CHECK(trajectory.pieces().size(), >, 0u);
    piece_ = trajectory.piece_index(std::max(scale.left_s, trajectory.pieces().front().start));
    steps_ = steps_of_piece(piece_);
}

double PlotCurve::end_of_piece(std::size_t piece) const {
    const auto& pieces = trajectory_->pieces();
    return piece + 1 < pieces.size() ? std::min(pieces[piece + 1].start, duration_) : duration_;
}

std::size_t PlotCurve::steps_of_piece(std::size_t index) const {
    const Piece& piece = trajectory_->pieces()[index];
    const double length = end_of_piece(index) - piece.start;
    if (!(length > 0)) return 1;
    // A chord over the time h leaves a parabola by |a| h^2 / 8.
    const double bend = piece.largest_acceleration() * scale_.px_per_m;
    const double curved = length * std::sqrt(bend / (8 * TrailCurve::kChordError));
    constexpr double kMost = 4096;
    return static_cast<std::size_t>(std::clamp(std::ceil(curved), 1.0, kMost));
}

TrailPoint PlotCurve::at(double t) const {
    return {t, scale_.px(t, trajectory_->at(t).position.z() - below_m_), true};
}

std::optional<TrailPoint> PlotCurve::next(double limit) {
    const auto& pieces = trajectory_->pieces();
    while (piece_ < pieces.size()) {
        const double start = pieces[piece_].start, end = end_of_piece(piece_);
        const double share = static_cast<double>(step_) / static_cast<double>(steps_);
        const double time = std::max(start + (end - start) * share, scale_.left_s);
        if (time > limit) return std::nullopt;
        if (++step_ >= steps_) {
            step_ = 0;
            if (++piece_ < pieces.size()) steps_ = steps_of_piece(piece_);
        }
        const TrailPoint point = at(time);
        if (last_ && (*last_ - point.px).norm() < TrailCurve::kLeastStep) continue;
        last_ = point.px;
        return point;
    }
    return std::nullopt;
}

}  // namespace carom
