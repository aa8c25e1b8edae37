// Rectangles of an Image's pixels.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

namespace carom {

/// Half open: `right` and `bottom` are the first column and row outside; y down.
struct PixelRect {
    int left = 0, top = 0, right = 0, bottom = 0;

    /// By its upper left corner and size.
    static PixelRect at(int left, int top, int width, int height) {
        return {left, top, left + width, top + height};
    }

    int width() const { return right - left; }
    int height() const { return bottom - top; }
    bool empty() const { return left >= right || top >= bottom; }
    double middle_x() const { return left + 0.5 * width(); }
    double middle_y() const { return top + 0.5 * height(); }
    bool operator==(const PixelRect&) const = default;
    /// Of the same size, with another upper edge.
    PixelRect with_top(int y) const { return at(left, y, width(), height()); }
    /// False where one of them is empty.
    bool overlaps(const PixelRect& other) const { return !common(other).empty(); }
    PixelRect common(const PixelRect& other) const {
        return {std::max(left, other.left), std::max(top, other.top), std::min(right, other.right),
                std::min(bottom, other.bottom)};
    }
    /// Around both.
    PixelRect joined(const PixelRect& other) const {
        if (empty()) return other;
        if (other.empty()) return *this;
        return {std::min(left, other.left), std::min(top, other.top), std::max(right, other.right),
                std::max(bottom, other.bottom)};
    }
};

/// At most `most` rectangles that cover the given ones and do not overlap: those that do are
/// joined.
inline std::vector<PixelRect> apart(const std::vector<PixelRect>& rects,
                                    std::size_t most = std::numeric_limits<std::size_t>::max()) {
    std::vector<PixelRect> found;
    for (PixelRect rect : rects) {
        if (rect.empty()) continue;
        // Joined with all that it overlaps, also those that it only then overlaps.
        for (std::size_t i = 0; i < found.size();) {
            if (!rect.overlaps(found[i]) && found.size() < most) {
                ++i;
                continue;
            }
            rect = rect.joined(found[i]);
            found.erase(found.begin() + static_cast<std::ptrdiff_t>(i));
            i = 0;
        }
        found.push_back(rect);
    }
    return found;
}

}  // namespace carom
