// The structural similarity of two pictures.
#pragma once

#include <vector>

#include "core/pixel_rect.h"

namespace carom {

/// Brightness of a picture, 0 ... 255, rows from the top without padding.
struct LumaPlane {
    int width = 0, height = 0;
    std::vector<float> values;
};

/// Mean over all places where the window fits into the picture: a Gaussian of 11 x 11 pixels with
/// sigma 1.5, K1 = 0.01, K2 = 0.03, L = 255 (Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli,
/// Image quality assessment: from error visibility to structural similarity, IEEE Transactions on
/// Image Processing 13(4), 2004, eq. 13-17). A picture with fewer than 11 rows or columns is one
/// window with equal weights. Both planes must have the same size and be equal outside `differing`.
double structural_similarity(const LumaPlane& a, const LumaPlane& b, const PixelRect& differing);

}  // namespace carom
