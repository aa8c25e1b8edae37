#include "render/element/trail_raster.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

namespace {

constexpr std::size_t kMostNumbers = std::numeric_limits<std::uint16_t>::max();

}  // namespace

TrailRaster::TrailRaster(int width_px, int height_px, std::vector<Ink> inks)
    : inks_(std::move(inks)),
      lines_per_number_(inks_.size() / kMostNumbers + 1),
      cells_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)),
      picture_(width_px, height_px) {}

bool TrailRaster::raise(Cell& cell, std::uint16_t line, std::uint8_t opacity) {
    if (opacity == 0) return false;
    std::size_t place = 2;
    for (std::size_t i = 0; i < 2; ++i)
        if (cell.line[i] == line) place = i;
    if (place < 2) {
        if (cell.opacity[place] >= opacity) return false;
        cell.opacity[place] = opacity;
    } else {
        // Replaces the weaker one if it is stronger, or as strong with a lower number.
        const bool stronger =
            opacity > cell.opacity[1] || (opacity == cell.opacity[1] && line < cell.line[1]);
        if (!stronger) return false;
        cell.line[1] = line;
        cell.opacity[1] = opacity;
    }
    const bool swapped =
        cell.opacity[1] > cell.opacity[0] ||
        (cell.opacity[1] == cell.opacity[0] && cell.line[1] != 0 && cell.line[1] < cell.line[0]);
    if (swapped) {
        std::swap(cell.line[0], cell.line[1]);
        std::swap(cell.opacity[0], cell.opacity[1]);
    }
    return true;
}

void TrailRaster::blend(std::size_t index) {
    const Cell& cell = cells_[index];
    std::uint8_t* pixel = picture_.bgra.data() + 4 * index;
    double b = 0, g = 0, r = 0, a = 0;
    // The higher number first, the lower one over it.
    const std::size_t below = cell.line[0] > cell.line[1] ? 0 : 1;
    for (const std::size_t i : {below, 1 - below}) {
        if (cell.line[i] == 0) continue;
        const Ink& ink = inks_[(cell.line[i] - 1u) * lines_per_number_];
        const double opacity = cell.opacity[i] / 255.0;
        b = ink.b * opacity + b * (1 - opacity);
        g = ink.g * opacity + g * (1 - opacity);
        r = ink.r * opacity + r * (1 - opacity);
        a = opacity + a * (1 - opacity);
    }
    const auto byte = [](double value) { return static_cast<std::uint8_t>(value * 255 + 0.5); };
    pixel[0] = byte(b);
    pixel[1] = byte(g);
    pixel[2] = byte(r);
    pixel[3] = byte(a);
}

void TrailRaster::draw(const Segment& s, bool for_good) {
    const double reach = s.half_width + 1;
    const auto span = [&](double a, double b, int size) {
        const double low = std::floor(std::min(a, b) - reach),
                     high = std::ceil(std::max(a, b) + reach);
        return Span{static_cast<int>(std::clamp(low, 0.0, double(size))),
                    static_cast<int>(std::clamp(high, 0.0, double(size)))};
    };
    const Span xs = span(s.from.x(), s.to.x(), picture_.width_px);
    const Span ys = span(s.from.y(), s.to.y(), picture_.height_px);
    if (xs.first >= xs.last || ys.first >= ys.last) return;

    const Vec2 along = s.to - s.from;
    const double length_2 = along.squaredNorm();
    const double outer = s.half_width + 0.5;
    const auto line =
        static_cast<std::uint16_t>(static_cast<std::size_t>(s.line) / lines_per_number_ + 1);
    for (int y = ys.first; y < ys.last; ++y) {
        for (int x = xs.first; x < xs.last; ++x) {
            // Distance of the pixel's centre from the segment, and where along it.
            const double dx = x + 0.5 - s.from.x(), dy = y + 0.5 - s.from.y();
            const double dot = dx * along.x() + dy * along.y();
            const double u = length_2 > 0 ? std::clamp(dot / length_2, 0.0, 1.0) : 0.0;
            const double ox = dx - u * along.x(), oy = dy - u * along.y();
            const double distance_2 = ox * ox + oy * oy;
            if (distance_2 >= outer * outer) continue;
            const double cover = std::min(outer - std::sqrt(distance_2), 1.0);
            const double opacity = s.opacity_from + u * (s.opacity_to - s.opacity_from);
            const auto byte = static_cast<std::uint8_t>(255 * cover * opacity + 0.5);
            const std::size_t index =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width_px) +
                static_cast<std::size_t>(x);
            const Cell before = cells_[index];
            if (!raise(cells_[index], line, byte)) continue;
            if (!for_good) saved_.push_back({index, before});
            blend(index);
        }
    }
    const PixelRect touched{xs.first, ys.first, xs.last, ys.last};
    changed_ = changed_.joined(touched);
    if (!for_good) passing_ = passing_.joined(touched);
}

void TrailRaster::take_back() {
    for (auto saved = saved_.rbegin(); saved != saved_.rend(); ++saved) {
        cells_[saved->index] = saved->cell;
        blend(saved->index);
    }
    saved_.clear();
    changed_ = changed_.joined(passing_);
    passing_ = {};
}

void TrailRaster::clear() {
    std::fill(cells_.begin(), cells_.end(), Cell{});
    std::fill(picture_.bgra.begin(), picture_.bgra.end(), std::uint8_t{0});
    saved_.clear();
    passing_ = {};
    changed_ = {0, 0, picture_.width_px, picture_.height_px};
}

PixelRect TrailRaster::take_changed() {
    const PixelRect changed = changed_;
    changed_ = {};
    return changed;
}

}  // namespace carom
