// Which shadow may fall where: the pictures of the balls' shadows, sorted into tiles of the screen.
#pragma once

#include <array>
#include <vector>

#include "render/background/background_picture.h"
#include "render/balls/balls_in_view.h"
#include "render/tile/screen_tiles.h"
#include "render/view/lights.h"
#include "scene/scene.h"

namespace carom {

/// For every tile that some shadow may touch, the balls that cast it. Nothing is missed: bounds are
/// generous by up to a tile.
class ShadowTiles {
  public:
    static constexpr int kTilePx = ScreenTiles::kTilePx;

    /// `seen`: what is seen in each tile, to drop tiles that a shadow passes before or behind;
    /// may be empty.
    ShadowTiles(const Scene& scene, const View& view, const Lights& lights,
                std::vector<TileBound> seen = {});

    /// Per non-empty tile: column, row, first caster, number of casters (whole numbers in floats).
    const std::vector<float>& tiles() const { return tiles_; }
    /// Centre (view space) and radius of each caster, tile after tile; where any is swept, each is
    /// followed by its way and a number that means nothing.
    const std::vector<float>& casters() const { return casters_; }
    /// The same casters as indices into Scene::balls.
    const std::vector<int>& caster_balls() const { return caster_balls_; }
    bool swept() const { return swept_; }

    void update(const std::vector<BallInView>& balls);

  private:
    struct Plane {
        Vec3 normal = Vec3::UnitZ();  ///< view space
        double offset = 0;
    };
    struct Body {
        Vec3 center = Vec3::Zero();  ///< view space
        double radius = 0;           ///< around everything
        ScreenTiles::Window seen_in{0, -1, 0, -1};
    };

    void add_plane(const PlaneShape& plane, const View& view);
    void add_body(const Vec3& center, double radius, const View& view);
    void cast_on_plane(const Plane& plane, const BallInView& ball);
    void add_ambient(const Plane& plane, const Vec3& center, double height, const BallInView& ball);
    void add_key(const Plane& plane, const Vec3& center, double height, const BallInView& ball);
    void add_octagon(const std::array<Vec3, 8>& octagon, const BallInView& ball,
                     std::vector<Vec3>& points);
    void mark_span(const ScreenTiles::Span& span, const BallInView& ball);
    void cast_on_body(const Body& body, const BallInView& ball);
    /// Marks the tiles of `window` that the hull of the points covers for the current caster.
    void mark_hull(const std::vector<Vec3>& points, const ScreenTiles::Window& window,
                   const BallInView& ball);
    /// False if the caster's shadow cannot reach what is seen in the tile.
    bool reaches(std::size_t tile, const BallInView& ball) const;

    Vec3 to_light_;  ///< view space
    double tan_radius_;
    ScreenTiles grid_;
    std::vector<TileBound> seen_;
    std::vector<Plane> planes_;
    std::vector<Body> bodies_;
    std::vector<Vec3> ambient_, key_;       ///< around what is being marked
    int caster_ = -1;                       ///< being marked
    std::vector<std::vector<int>> marked_;  ///< per tile, casters in order
    std::vector<float> tiles_, casters_;
    std::vector<int> caster_balls_;
    bool swept_ = false;
};

}  // namespace carom
