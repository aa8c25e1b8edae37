#include "render/view/lights.h"

namespace carom {

Lights choose_lights(const View& view) {
    const Vec3 up = Vec3::UnitZ();
    // The camera's right hand, made level; a camera that is rolled on its side uses its heading.
    Vec3 right = view.right() - up * up.dot(view.right());
    if (right.norm() < 1e-3) right = view.up().cross(up);
    if (right.norm() < 1e-3) right = Vec3::UnitX();
    right.normalize();
    const Vec3 towards_viewer = right.cross(up);

    Lights lights;
    lights.to_light = (-0.50 * right + 0.42 * towards_viewer + 1.0 * up).normalized();
    return lights;
}

}  // namespace carom
