#include "render/view/picture_scale.h"

#include <algorithm>
#include <vector>

namespace carom {

namespace {

double median_radius(const Scene& scene) {
    std::vector<double> radii;
    for (const Ball& ball : scene.balls) radii.push_back(ball.radius);
    if (radii.empty()) return 0;
    const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
    std::nth_element(radii.begin(), middle, radii.end());
    return *middle;
}

}  // namespace

PictureScale scale_of(const Scene& scene, const Camera& camera) {
    const double distance = (camera.to - camera.from).norm();
    const double radius = median_radius(scene);
    PictureScale scale;
    scale.fade_m = 5.0 * distance;
    scale.ao_reach_m = radius > 0 ? 2.0 * radius : 0.05 * distance;
    return scale;
}

}  // namespace carom
