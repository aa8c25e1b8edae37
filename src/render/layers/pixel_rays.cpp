#include "render/layers/pixel_rays.h"

#include "render/view/view_space.h"

namespace carom {

Ray pixel_ray(const View& view, double x_px, double y_px) {
    const double width = pixel_width(view);
    const Vec3 aside = width * ((x_px - 0.5 * view.width_px()) * view.right() -
                                (y_px - 0.5 * view.height_px()) * view.up());
    if (view.orthographic()) return {view.eye() + aside, view.forward()};
    return {view.eye(), (view.forward() + aside).normalized()};
}

Ray ray_to(const View& view, const Vec3& point) {
    const Vec3 from_eye = point - view.eye();
    if (view.orthographic())
        return {point - from_eye.dot(view.forward()) * view.forward(), view.forward()};
    return {view.eye(), from_eye.normalized()};
}

}  // namespace carom
