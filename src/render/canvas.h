// Drawing with cairo straight onto an Image, and laying small pictures over larger ones.
#pragma once

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

/// `source` over `target` with its top left corner at (x, y); what hangs out is cut off.
void lay_over(const Image& source, int x, int y, Image& target);

}  // namespace carom
