// The passes that draw what moves over the background, in their order.
#pragma once

#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "render/background/background_picture.h"
#include "render/balls/ball_billboards.h"
#include "render/balls/ball_reflections.h"
#include "render/balls/ball_shadows.h"
#include "render/balls/drawn_balls.h"
#include "render/gl/offscreen.h"
#include "render/picture/picture_setup.h"

namespace carom {

/// Shadows, mirror images, balls, ghosts: those that the scene has.
///
/// Programs take longer to compile than one picture to draw, and belong to the context that
/// compiles them. So balls and ghosts may be drawn in the contexts' other one, where another thread
/// has compiled them; every drawing here begins and ends in the main one.
class FramePasses {
  public:
    struct Contents {
        const Scene& scene;
        const SecondRun* second;  ///< drawn as ghosts; may be null
        bool transparent;
        bool few_pictures;  ///< see PainterOptions
    };
    /// Of pictures in `color`. The main context is current, and all that is named must outlive it.
    FramePasses(DrawingContexts& contexts, const Contents& contents, const PictureSetup& setup,
                const GlTexture& color);
    ~FramePasses();
    FramePasses(const FramePasses&) = delete;
    FramePasses& operator=(const FramePasses&) = delete;

    /// Makes and compiles all that prepare_in_second_context() has not taken.
    void prepare(const BackgroundPicture& background);
    /// The same beginning from the last, while prepare() is on its way: from another thread, where
    /// contexts.second is current.
    void prepare_in_second_context(const BackgroundPicture& background);

    /// Another view of the same size and kind; `seen`: see ShadowTiles. Not after
    /// prepare_in_second_context().
    void set_view(const View& view, const Lights& lights, const PictureScale& scale);
    void see_in_tiles(const View& view, const Lights& lights, std::vector<TileBound> seen);

    /// What lies below the balls, and they; between the two a layer may be laid over the frame.
    void draw_below(const DrawnBalls& bodies, const BackgroundPicture& background);
    void draw_balls(const DrawnBalls& bodies, const BackgroundPicture& background);

    /// The same within the tiles of a mask, which hold all of the bodies that are marked as drawn;
    /// after cast().
    void draw_below_within(const TileMask& mask, const DrawnBalls& bodies,
                           const BackgroundPicture& background);
    /// Tiles in which some pass looks at more of the background than its colours; after cast().
    TileMask looks_closely(const DrawnBalls& bodies, const View& view) const;

    /// Finds the shadows of all balls; null where there are none.
    const ShadowTiles* cast(const DrawnBalls& bodies) {
        return shadows_ ? &shadows_->cast(bodies.balls) : nullptr;
    }
    /// Mirror images that may be seen.
    std::vector<BallInView> images(const DrawnBalls& bodies) const {
        return reflections_ ? reflections_->images(bodies.balls) : std::vector<BallInView>{};
    }

    /// Adds the tiles of the balls, of their images and of the shadows that they cast. Bodies
    /// are the scene's balls, then those of the second run.
    void mark(const DrawnBalls& bodies, const View& view, TileOwners& owners);

    /// For draw_below() and all that the main context draws.
    const GlFramebuffer& frame() const { return frame_; }
    bool has_shadows() const { return shadows_.has_value(); }
    bool has_reflections() const { return reflections_.has_value(); }
    bool has_ghosts() const { return contents_.second != nullptr; }

  private:
    /// A pass that either thread prepares.
    struct Shared {
        std::optional<BallBillboards> pass;
        bool in_second = false;  ///< in whose context it is
    };
    Shared* take_first();
    Shared* take_last();
    void prepare(Shared& shared, const Gl& gl, const BackgroundPicture& background);
    void draw_in_its_context(Shared& shared, const std::function<void(BallBillboards&)>& draw);

    DrawingContexts& contexts_;
    const Gl& gl_;
    Contents contents_;
    const PictureSetup& setup_;
    const GlTexture& color_;
    BallSurroundings around_;
    GlFramebuffer frame_, second_frame_;
    std::optional<BallShadows> shadows_;
    std::optional<BallReflections> reflections_;
    Shared balls_, ghosts_;
    std::mutex taking_;
    std::deque<Shared*> open_;  ///< not taken yet, in the order in which they are drawn
};

}  // namespace carom
