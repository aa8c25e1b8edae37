#include "render/layers/snapshot.h"

#include <algorithm>

#include "geometry/bounds.h"

namespace carom {

namespace {

/// Of a distance: a point of a surface is not hidden by that surface, nor by what touches it there.
constexpr double kBefore = 1 - 1e-6;

}  // namespace

SeenSurfaces::SeenSurfaces(const Scene& scene, const View& view)
    : scene_(scene), tiles_(view.width_px(), view.height_px()) {
    std::vector<PixelRect> places;
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
        const SurfaceShape& shape = scene.surfaces[i].shape;
        if (!is_unbounded(shape)) {
            const SphereAround around = sphere_around(shape);
            bounded_.push_back(static_cast<int>(i));
            places.push_back(pixels_of_sphere(around.center, around.radius, view));
        } else if (scene.background != Background::kTransparent) {
            unbounded_.push_back(static_cast<int>(i));
        }
    }
    tiles_.fill(places);
}

template <class Use>
void SeenSurfaces::for_each(int x_px, int y_px, const Use& use) const {
    for (const int surface : unbounded_) use(surface);
    for (const int place : tiles_.list(tiles_.index_of(x_px, y_px)))
        use(bounded_[static_cast<std::size_t>(place)]);
}

Seen SeenSurfaces::nearest(const Ray& ray, int x_px, int y_px) const {
    Seen seen;
    for_each(x_px, y_px, [&](int surface) {
        const auto hit = first_hit(scene_.surfaces[static_cast<std::size_t>(surface)].shape, ray);
        if (hit && hit->distance < seen.distance)
            seen = {hit->distance, static_cast<int>(scene_.balls.size()) + surface};
    });
    return seen;
}

bool SeenSurfaces::hides(const Ray& ray, double distance, bool on_surface, int x_px,
                         int y_px) const {
    const double met = nearest(ray, x_px, y_px).distance;
    return met < distance * kBefore || (on_surface && !(met * kBefore <= distance));
}

Vec3 SeenSurfaces::normal(int surface, const Ray& ray) const {
    const auto hit = first_hit(scene_.surfaces[static_cast<std::size_t>(surface)].shape, ray);
    return hit ? hit->normal : Vec3(-ray.direction);
}

SeenBalls::SeenBalls(const Scene& scene, const Motion& motion, double t, const View& view)
    : tiles_(view.width_px(), view.height_px()) {
    for (std::size_t i = 0; i < scene.balls.size(); ++i) {
        const BallState state = motion.balls[i].at(t);
        spheres_.push_back({state.position, scene.balls[i].radius});
        turns_.push_back(state.orientation.toRotationMatrix());
        pixels_.push_back(pixels_of_sphere(state.position, scene.balls[i].radius, view));
    }
    tiles_.fill(pixels_);
}

Seen SeenBalls::nearest(const Ray& ray, int x_px, int y_px, const Seen& behind) const {
    Seen seen = behind;
    for (const int ball : tiles_.list(tiles_.index_of(x_px, y_px))) {
        const auto hit = first_hit(sphere(ball), ray);
        if (hit && hit->distance < seen.distance) seen = {hit->distance, ball};
    }
    return seen;
}

bool SeenBalls::hides(const Ray& ray, double distance, int own, int x_px, int y_px) const {
    const std::span<const int> near = tiles_.list(tiles_.index_of(x_px, y_px));
    return std::any_of(near.begin(), near.end(), [&](int ball) {
        if (ball == own) return false;
        const auto hit = first_hit(sphere(ball), ray);
        return hit && hit->distance < distance * kBefore;
    });
}

}  // namespace carom
