// The pass that draws the static picture.
#pragma once

#include <functional>
#include <future>
#include <map>
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

/// One program for the whole picture; or one for each set of kinds of bodies that parts of it have
/// to do with, for a camera that moves: most parts show but planes, and a program for those takes a
/// third of the time. Same pixels.
enum class StaticPrograms { kOne, kEachSetOfBodies };

/// Draws into a StaticPicture, from the context that is current when it is made: the picture's own,
/// or one that shares its textures. Program and framebuffer belong to that context alone.
class StaticDrawing {
  public:
    /// `gl` must outlive it.
    StaticDrawing(const Gl& gl, const StaticKind& kind,
                  StaticPrograms programs = StaticPrograms::kOne)
        : gl_(&gl), kind_(kind), each_set_(programs == StaticPrograms::kEachSetOfBodies) {}

    /// What to draw into from now on: a picture of this kind, which must outlive it.
    void aim(const StaticPicture& target);
    /// Makes the one program for such views and surfaces, if it is another one than before.
    void compile(const View& view, const SurfaceTable& table);

    /// Again for another view of the same size and kind, too. The other one has lists of bodies
    /// that are known to hold.
    void draw(const View& view, const Lights& lights, const SurfaceTable& table,
              const PictureScale& scale);
    void draw(const View& view, const Lights& lights, const SurfaceTable& table,
              const PictureScale& scale, const BodyTiles& tiles);

  private:
    GlProgram& program_for(const View& view, const SurfaceTable& table, unsigned bodies);
    void draw_rectangles(GlProgram& program, const View& view, const Lights& lights,
                         const SurfaceTable& table, const PictureScale& scale,
                         const std::vector<float>& rectangles);

    const Gl* gl_;
    StaticKind kind_;
    bool each_set_;
    std::map<std::vector<std::string>, GlProgram> programs_;  ///< by what they are made with
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
                  const std::shared_future<const StaticPicture*>& target,
                  const std::function<void(const StaticPicture&)>& then);

}  // namespace carom
