#include "render/balls/caster_cells.h"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

/// More would be mostly empty.
int cells_along(double extent_m, double cell_m, std::size_t balls) {
    const double most = std::max(1.0, std::sqrt(static_cast<double>(balls)));
    return static_cast<int>(std::clamp(std::floor(extent_m / cell_m), 1.0, most));
}

}  // namespace

bool may_shade(const BallInView& other, const BallInView& ball, const Vec3& to_light,
               double light_tan) {
    const Vec3 rel = other.center - ball.center;
    const double along = rel.dot(to_light);
    const double reach = ball.radius + other.radius;
    if (along < -reach) return false;
    const double across2 = rel.squaredNorm() - along * along;
    const double wide = reach + std::max(0.0, along) * light_tan;
    if (across2 > wide * wide) return false;
    // A lamp that looks much larger than the caster hides the shadow.
    return along * light_tan <= kLargestLamp * other.radius;
}

CasterCells::CasterCells(const std::vector<BallInView>& balls, const Vec3& to_light)
    : u_(to_light.unitOrthogonal()), v_(to_light.cross(u_)), cells_(1) {
    if (balls.empty()) return;
    Eigen::AlignedBox2d extent;
    double largest = 0;
    for (const BallInView& ball : balls) {
        extent.extend(Vec2(u_.dot(ball.center), v_.dot(ball.center)));
        largest = std::max(largest, ball.radius);
    }
    // A shadow is as wide as its ball and the lamp's penumbra; it meets a ball that reaches into
    // it.
    const auto reach = [&](double radius) {
        constexpr double kRounding = 1 + 1e-6;
        return kRounding * ((1 + kLargestLamp) * radius + largest);
    };
    least_ = extent.min();
    const double widest = std::max(extent.sizes().maxCoeff(), 1e-9);
    cell_m_ = std::max(2 * reach(largest), widest / std::sqrt(static_cast<double>(balls.size())));
    columns_ = cells_along(extent.sizes().x(), cell_m_, balls.size()) + 1;
    rows_ = cells_along(extent.sizes().y(), cell_m_, balls.size()) + 1;
    cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const Vec2 at(u_.dot(balls[i].center), v_.dot(balls[i].center));
        const double r = reach(balls[i].radius);
        for (int row = row_of(at.y() - r); row <= row_of(at.y() + r); ++row)
            for (int column = column_of(at.x() - r); column <= column_of(at.x() + r); ++column)
                cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                       static_cast<std::size_t>(column)]
                    .push_back(static_cast<int>(i));
    }
}

int CasterCells::column_of(double across_m) const {
    const double column = std::floor((across_m - least_.x()) / cell_m_);
    return static_cast<int>(std::clamp(column, 0.0, columns_ - 1.0));
}

int CasterCells::row_of(double across_m) const {
    const double row = std::floor((across_m - least_.y()) / cell_m_);
    return static_cast<int>(std::clamp(row, 0.0, rows_ - 1.0));
}

const std::vector<int>& CasterCells::near(const BallInView& ball) const {
    const auto row = static_cast<std::size_t>(row_of(v_.dot(ball.center)));
    const auto column = static_cast<std::size_t>(column_of(u_.dot(ball.center)));
    return cells_[row * static_cast<std::size_t>(columns_) + column];
}

}  // namespace carom
