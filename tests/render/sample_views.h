// Pictures that the tests of the overlay draw on.
#pragma once

#include <cstdint>

#include "core/image.h"
#include "render/camera.h"
#include "render/overlay.h"
#include "sample_motions.h"

namespace carom::samples {

struct Size {
    int width, height;
};
inline constexpr Size kSizes[] = {{1280, 720}, {640, 360}, {320, 180}, {3840, 2160}, {720, 1280}};

inline View view_of(const Sample& sample, const Size& size) {
    const double aspect = static_cast<double>(size.width) / size.height;
    return View(choose_camera(sample.scene, sample.motion, aspect), size.width, size.height);
}

inline bool overlap(const OverlayPainter::Rect& a, const OverlayPainter::Rect& b) {
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height &&
           b.y < a.y + a.height;
}

inline bool inside(const OverlayPainter::Rect& r, const Size& size) {
    return r.x >= 0 && r.y >= 0 && r.x + r.width <= size.width && r.y + r.height <= size.height;
}

inline int alpha_at(const Image& picture, int x, int y) { return picture.row(y)[4 * x + 3]; }

}  // namespace carom::samples
