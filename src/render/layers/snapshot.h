// A scene at one instant, as rays through the picture meet it.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "geometry/ray.h"
#include "motion/motion.h"
#include "render/layers/tile_lists.h"
#include "render/view/camera.h"
#include "scene/scene.h"

namespace carom {

/// What a ray meets first. Bodies are the scene's balls, then its surfaces.
struct Seen {
    static constexpr int kNothing = -1;
    double distance = std::numeric_limits<double>::infinity();  ///< m along the ray
    int body = kNothing;
};

/// The static bodies that rays of one view may meet: those that the picture shows.
class SeenSurfaces {
  public:
    /// `scene` must outlive it. Planes are left out of transparent pictures, as they are there.
    SeenSurfaces(const Scene& scene, const View& view);

    /// For the ray of a pixel.
    Seen nearest(const Ray& ray, int x_px, int y_px) const;
    /// Whether one of them stands before a place so far along the ray; a place that is on one of
    /// them (`on_surface`) is also hidden where the ray does not meet it, as on a plane's back.
    bool hides(const Ray& ray, double distance, bool on_surface, int x_px, int y_px) const;
    /// Of a ray that meets this surface.
    Vec3 normal(int surface, const Ray& ray) const;

  private:
    template <class Use>
    void for_each(int x_px, int y_px, const Use& use) const;

    const Scene& scene_;
    std::vector<int> unbounded_;  ///< places in Scene::surfaces
    std::vector<int> bounded_;
    TileLists tiles_;  ///< of places in bounded_
};

/// The balls of one instant in one view.
class SeenBalls {
  public:
    SeenBalls(const Scene& scene, const Motion& motion, double t, const View& view);

    /// The nearest one on a pixel's ray, or `behind` where none is before that.
    Seen nearest(const Ray& ray, int x_px, int y_px, const Seen& behind) const;
    /// Whether a ball, except for `own`, stands before a place so far along the ray.
    bool hides(const Ray& ray, double distance, int own, int x_px, int y_px) const;
    /// Whether a ray of this pixel may meet one at all, tile by tile.
    bool any_near(std::size_t tile) const { return !tiles_.list(tile).empty(); }
    const TileLists& tiles() const { return tiles_; }

    int count() const { return static_cast<int>(spheres_.size()); }
    const SphereShape& sphere(int ball) const { return spheres_[static_cast<std::size_t>(ball)]; }
    const Mat3& world_from_ball(int ball) const { return turns_[static_cast<std::size_t>(ball)]; }
    /// Pixels that may show it.
    const PixelRect& pixels(int ball) const { return pixels_[static_cast<std::size_t>(ball)]; }

  private:
    std::vector<SphereShape> spheres_;
    std::vector<Mat3> turns_;
    std::vector<PixelRect> pixels_;
    TileLists tiles_;
};

}  // namespace carom
