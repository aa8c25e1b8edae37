// Drawing with cairo straight onto an Image, and laying small pictures over larger ones.
#pragma once

#include <cstdint>
#include <memory>

#include "core/image.h"

struct _cairo;

namespace carom {

/// sRGB colour with coverage, each 0 ... 1, not premultiplied.
struct Ink {
    double r = 0, g = 0, b = 0, a = 1;
};

/// A cairo context on the memory of an Image, which must outlive it and keep its size. The picture
/// is complete after finish(). Whatever cairo reports is Failure(kRun) with cairo's text.
class Canvas {
  public:
    explicit Canvas(Image& image);
    ~Canvas();
    Canvas(Canvas&&) noexcept;
    Canvas& operator=(Canvas&&) noexcept;

    _cairo* context() const { return context_.get(); }
    void use(const Ink& ink);  ///< the source for what follows
    /// Path of a rectangle with round corners.
    void round_rect(double x, double y, double width, double height, double radius);
    void finish();

  private:
    struct Destroy {
        void operator()(_cairo* context) const;
    };
    std::unique_ptr<_cairo, Destroy> context_;
};

/// One premultiplied pixel over another.
inline void lay_pixel_over(const std::uint8_t* from, std::uint8_t* to) {
    if (from[3] == 0) return;
    const unsigned rest = 255u - from[3];
    for (int c = 0; c < 4; ++c) {
        // Division by 255, rounded to nearest, exact for 0 ... 65025.
        const unsigned product = to[c] * rest + 128;
        to[c] = static_cast<std::uint8_t>(from[c] + ((product + (product >> 8)) >> 8));
    }
}

/// `source` over `target` with its top left corner at (x, y); what hangs out is cut off.
void lay_over(const Image& source, int x, int y, Image& target);

}  // namespace carom
