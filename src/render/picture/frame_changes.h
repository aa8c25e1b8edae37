// What of a frame has to be drawn anew, where the frame before is still there.
#pragma once

#include <cstddef>
#include <vector>

#include "core/pixel_rect.h"
#include "render/balls/drawn_balls.h"
#include "render/balls/shadow_tiles.h"
#include "render/tile/tile_mask.h"
#include "render/view/camera.h"
#include "render/view/lights.h"

namespace carom {

/// Compares the bodies of a picture, their mirror images and their shadows with those of the
/// picture before. For a camera that stands.
///
/// A body that shares a tile with what changes is drawn anew as a whole, since its edges are laid
/// over what is below them; so the pixels are those of a picture that is drawn from nothing.
class FrameChanges {
  public:
    /// `balls`: of the scene; those of the second run are numbered behind them.
    FrameChanges(const View& view, const Lights& lights, std::size_t balls);

    /// The next picture is drawn as a whole.
    void forget() { known_ = false; }

    /// Finds what changes: with the bodies `images` of their mirror images, and `shadows` of the
    /// balls (null: there are none). Of the bodies, those that need not be drawn are marked.
    /// `others`: rectangles that change for other reasons.
    void update(DrawnBalls& bodies, const std::vector<BallInView>& images,
                const ShadowTiles* shadows, const std::vector<PixelRect>& others);

    const TileMask& tiles() const { return tiles_; }
    /// The same as rectangles that do not overlap; not many.
    const std::vector<PixelRect>& rects() const { return rects_; }

  private:
    struct Body {
        bool there = false;
        BallInView ball;
        std::vector<PixelRect> parts;  ///< of the picture: of itself and its images
        bool operator==(const Body& other) const;
    };
    using Bodies = std::vector<Body>;

    std::size_t number(const BallInView& body, bool ghost) const {
        return static_cast<std::size_t>(body.index) + (ghost ? balls_ : 0);
    }
    Bodies gather(const DrawnBalls& bodies, const std::vector<BallInView>& images) const;
    std::vector<bool> changed_bodies(const DrawnBalls& bodies) const;
    void mark_bodies(const std::vector<bool>& changed);
    void mark_shadows(const ShadowTiles& shadows, const std::vector<bool>& changed);
    /// Adds all of each body that shares a tile with what changes. True if there was one.
    bool add_neighbours();
    void add_what_hangs_together();

    View view_;
    Vec3 to_light_;  ///< view space
    double light_tan_;
    std::size_t balls_;
    bool known_ = false;  ///< what the picture before showed
    Bodies before_, now_;
    std::vector<BallInView> balls_before_;
    std::vector<float> shadows_before_;  ///< ShadowTiles::tiles()
    std::vector<int> casters_before_;    ///< ShadowTiles::caster_balls()
    std::vector<bool> drawn_;            ///< by body
    TileMask tiles_;
    std::vector<PixelRect> rects_;
};

}  // namespace carom
