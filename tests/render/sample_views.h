// Pictures that the tests of the overlay draw on.
#pragma once

#include <cstdint>

#include "core/image.h"
#include "render/overlay/overlay.h"
#include "render/view/camera.h"
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

inline bool inside(const PixelRect& r, const Size& size) {
    return r.left >= 0 && r.top >= 0 && r.right <= size.width && r.bottom <= size.height;
}

inline int alpha_at(const Image& picture, int x, int y) { return picture.row(y)[4 * x + 3]; }

}  // namespace carom::samples
