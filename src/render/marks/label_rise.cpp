#include "render/marks/label_rise.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom {

namespace {

constexpr int kSteps = 16;  ///< to either side
constexpr double kStep_s = LabelRises::kReach_s / kSteps;
const int kLasting = static_cast<int>(std::lround(LabelRises::kBrief_s / kStep_s));

/// 0 at 0 and 1 at 1, without a bend at either.
double smooth(double share) {
    const double x = std::clamp(share, 0.0, 1.0);
    return x * x * (3 - 2 * x);
}

}  // namespace

double rise_over_balls(const LabelBox& label, std::size_t own, const std::vector<BallDisc>& discs) {
    // A ball that a label just touches is seen well enough.
    constexpr double kTouch = 0.85;  // of the radius
    double bottom = label.bottom;
    for (std::size_t moves = 0; moves <= discs.size(); ++moves) {
        double above = bottom;
        for (std::size_t i = 0; i < discs.size(); ++i) {
            const BallDisc& disc = discs[i];
            if (i == own || !disc.in_picture) continue;
            const double x = disc.center.x(), radius = kTouch * disc.radius;
            const double aside = std::max({label.left - x, x - label.right, 0.0});
            if (aside >= radius) continue;
            const double half = std::sqrt((radius - aside) * (radius + aside));
            const double top = disc.center.y() - half, foot = disc.center.y() + half;
            if (bottom > top && bottom - label.height < foot) above = std::min(above, top);
        }
        if (above == bottom) break;
        bottom = above;
    }
    return label.bottom - bottom;
}

LabelRises::LabelRises(std::function<std::vector<double>(double film_s)> ways_at)
    : ways_at_(std::move(ways_at)) {}

void LabelRises::forget() { ways_.clear(); }

const std::vector<double>& LabelRises::ways(std::int64_t step) {
    const auto [place, is_new] = ways_.try_emplace(step);
    if (is_new) place->second = ways_at_(static_cast<double>(step) * kStep_s);
    return place->second;
}

double LabelRises::lasting(std::int64_t step, std::size_t label) {
    double longest = 0;
    for (int first = -kLasting; first <= 0; ++first) {
        double least = ways(step)[label];
        for (int k = first; k <= first + kLasting && least > longest; ++k)
            least = std::min(least, ways(step + k)[label]);
        longest = std::max(longest, least);
    }
    return longest;
}

std::vector<double> LabelRises::at(double film_s) {
    const auto first = static_cast<std::int64_t>(std::ceil((film_s - kReach_s) / kStep_s));
    const auto last = static_cast<std::int64_t>(std::floor((film_s + kReach_s) / kStep_s));
    // Of long films only what is near is kept.
    ways_.erase(ways_.begin(), ways_.lower_bound(first - 2 * kLasting));
    ways_.erase(ways_.upper_bound(last + 2 * kLasting), ways_.end());
    std::vector<double> rises(ways(first).size(), 0.0);
    for (std::int64_t step = first; step <= last; ++step) {
        const double apart_s = std::abs(static_cast<double>(step) * kStep_s - film_s);
        const double weight = smooth(1 - apart_s / kReach_s);
        for (std::size_t label = 0; label < rises.size(); ++label)
            if (ways(step)[label] * weight > rises[label])
                rises[label] = std::max(rises[label], weight * lasting(step, label));
    }
    return rises;
}

double opacity_of_risen(double rise_px, double height_px) {
    return 1 - smooth(rise_px / height_px - 2);
}

}  // namespace carom
