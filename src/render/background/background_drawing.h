// The pass that draws the background.
#pragma once

#include <functional>
#include <future>
#include <map>
#include <string>
#include <vector>

#include "render/background/background_parts.h"
#include "render/background/background_picture.h"
#include "render/background/surface_table.h"
#include "render/background/surface_tiles.h"
#include "render/gl/gl_program.h"
#include "render/gl/offscreen.h"
#include "render/view/lights.h"
#include "render/view/picture_scale.h"

namespace carom {

/// One program for the whole picture; or one for each kind of parts (background_parts.h), for a
/// camera that moves: most parts show a plane or the sky alone, and programs for those take a
/// fraction of the time. Same pixels.
enum class BackgroundPrograms { kOne, kEachSetOfBodies };

/// Draws into a BackgroundPicture, from the context that is current when it is made: the picture's
/// own, or one that shares its textures. Program and framebuffer belong to that context alone.
class BackgroundDrawing {
  public:
    /// `gl` must outlive it.
    BackgroundDrawing(const Gl& gl, const BackgroundKind& kind,
                      BackgroundPrograms programs = BackgroundPrograms::kOne)
        : gl_(&gl), kind_(kind), each_set_(programs == BackgroundPrograms::kEachSetOfBodies) {}

    /// What to draw into from now on: a picture of this kind, which must outlive it.
    void aim(const BackgroundPicture& target);
    /// Makes the one program for such views and surfaces, if it is another one than before.
    void compile(const View& view, const SurfaceTable& table);

    /// Again for another view of the same size and kind, too. The other one has lists of bodies
    /// that are known to hold. With kEachSetOfBodies, tiles that are not `detailed` may be left
    /// without the G-buffer and what else goes with the colours; null: none.
    void draw(const View& view, const Lights& lights, const SurfaceTable& table,
              const PictureScale& scale);
    void draw(const View& view, const Lights& lights, const SurfaceTable& table,
              const PictureScale& scale, const SurfaceTiles& tiles,
              const TileMask* detailed = nullptr);

  private:
    GlProgram& program_for(const View& view, const SurfaceTable& table, const PartKind& part);
    void draw_rectangles(GlProgram& program, const View& view, const Lights& lights,
                         const SurfaceTable& table, const PictureScale& scale,
                         const std::vector<float>& rectangles);

    const Gl* gl_;
    BackgroundKind kind_;
    bool each_set_;
    std::map<std::vector<std::string>, GlProgram> programs_;  ///< by what they are made with
    GlFramebuffer framebuffer_, plain_framebuffer_, color_framebuffer_;  ///< of parts
};

/// All that one drawing depends on.
struct BackgroundContents {
    const View& view;
    const Lights& lights;
    const SurfaceTable& table;
    const PictureScale& scale;
    BackgroundKind kind;
};

/// Draws once in the second context; for any thread. The program is made before `target` is waited
/// for. When this returns the picture is complete and the context released; the thread's CPU
/// seconds come back. `then`, if there is any, is called before that, with the context current.
double draw_in_second_context(DrawingContexts& contexts, const BackgroundContents& contents,
                              const std::shared_future<const BackgroundPicture*>& target,
                              const std::function<void(const BackgroundPicture&)>& then);

}  // namespace carom
