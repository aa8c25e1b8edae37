// The pass that draws the static picture.
#pragma once

#include <functional>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "render/body_tiles.h"
#include "render/gl_program.h"
#include "render/lights.h"
#include "render/offscreen.h"
#include "render/picture_scale.h"
#include "render/static_picture.h"
#include "render/surface_table.h"

namespace carom {

/// Draws into a StaticPicture, from the context that is current when it is made: the picture's own,
/// or one that shares its textures. Program and framebuffer belong to that context alone.
class StaticDrawing {
  public:
    /// `gl` must outlive it.
    StaticDrawing(const Gl& gl, const StaticKind& kind) : gl_(&gl), kind_(kind) {}

    /// What to draw into from now on: a picture of this kind, which must outlive it.
    void aim(const StaticPicture& target);
    /// Makes the program for such views and surfaces, if it is another one than before.
    void compile(const View& view, const SurfaceTable& table);

    /// Again for another view of the same size and kind, too. The other one has lists of bodies
    /// that are known to hold.
    void draw(const View& view, const Lights& lights, const SurfaceTable& table,
              const PictureScale& scale);
    void draw(const View& view, const Lights& lights, const SurfaceTable& table,
              const PictureScale& scale, const BodyTiles& tiles);

  private:
    const Gl* gl_;
    StaticKind kind_;
    std::vector<std::string> defines_;  ///< of the program
    std::optional<GlProgram> program_;
    GlFramebuffer framebuffer_;
};

/// All that one drawing depends on.
struct StaticContents {
    const View& view;
    const Lights& lights;
    const SurfaceTable& table;
    const PictureScale& scale;
    StaticKind kind;
};

/// Draws once with the context aside; for any thread. The program is made before `target` is waited
/// for. When this returns the picture is complete and the context released; the thread's CPU
/// seconds come back. `then`, if there is any, is called before that, with the context current.
double draw_aside(DrawingContexts& contexts, const StaticContents& contents,
                  std::future<const StaticPicture*> target,
                  const std::function<void(const StaticPicture&)>& then);

}  // namespace carom
