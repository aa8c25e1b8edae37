// Where a point of a body that one picture shows is in another.
#pragma once

#include "geometry/ray.h"
#include "render/layers/snapshot.h"
#include "render/view/camera.h"

namespace carom {

/// A picture: its camera and what it shows.
struct SeenScene {
    const View* view = nullptr;
    const SeenSurfaces* surfaces = nullptr;
    const SeenBalls* balls = nullptr;
};

/// Pixels, x to the right and y down.
struct Flow {
    Vec2 way = Vec2::Zero();  ///< not a number where the point is not before the other eye
    bool hidden = false;      ///< in the other picture: beside it, turned away, or behind a body
};

/// Of the point that the ray of the place (x, y) [px] of picture `from` meets: it moves and turns
/// with its body, exactly. Of the sky it is a direction; parallel rays that turn show another sky.
Flow optical_flow(const SeenScene& from, const SeenScene& to, const Ray& ray, const Seen& seen,
                  const Vec2& pixel);

}  // namespace carom
