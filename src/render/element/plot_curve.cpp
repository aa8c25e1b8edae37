#include "render/element/plot_curve.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.h"
#include "render/element/height_range.h"

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

std::optional<double> PlotCurve::end_of_crowded(std::size_t piece) const {
    constexpr double kColumnPx = 0.5;
    constexpr std::size_t kMany = 16;  // pieces; each may have corners of its own
    const auto& pieces = trajectory_->pieces();
    if (pieces.size() - piece <= kMany) return std::nullopt;
    const double start_px = (pieces[piece].start - scale_.left_s) * scale_.px_per_s;
    if (!(start_px >= 0)) return std::nullopt;
    const double column = std::floor(start_px / kColumnPx);
    const double end = scale_.left_s + (column + 1) * kColumnPx / scale_.px_per_s;
    if (pieces[piece + kMany].start >= end) return std::nullopt;
    return end;
}

/// All pieces that start before `end`: one corner, the other one waits.
TrailPoint PlotCurve::take_crowded(double end) {
    const auto& pieces = trajectory_->pieces();
    const double time = pieces[piece_].start;
    HeightRange heights;
    for (; piece_ < pieces.size() && pieces[piece_].start < end; ++piece_)
        heights.add(pieces[piece_], pieces[piece_].start, end_of_piece(piece_));
    if (piece_ < pieces.size()) steps_ = steps_of_piece(piece_);
    TrailPoint first{time, scale_.px(time, heights.low_m - below_m_), true};
    TrailPoint second{time, scale_.px(time, heights.high_m - below_m_), true};
    if (last_ && (*last_ - second.px).norm() < (*last_ - first.px).norm()) std::swap(first, second);
    last_ = second.px;
    waiting_ = second;
    return first;
}

std::optional<TrailPoint> PlotCurve::next(double limit) {
    if (waiting_) return std::exchange(waiting_, std::nullopt);
    const auto& pieces = trajectory_->pieces();
    while (piece_ < pieces.size()) {
        if (const auto end = step_ == 0 ? end_of_crowded(piece_) : std::nullopt) {
            if (std::min(*end, duration_) > limit) return std::nullopt;
            return take_crowded(*end);
        }
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
