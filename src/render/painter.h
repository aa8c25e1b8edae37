// Draws the motion of a scene at any instant: Motion at t -> Image. Needs no display.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/image.h"
#include "motion/motion.h"
#include "render/picture/options.h"
#include "render/picture/picture.h"
#include "scene/scene.h"

namespace carom {

/// Has an offscreen context; use it from the thread that made it. `scene` and `motion` must
/// outlive it. Everything that can fail (context, shaders, framebuffer, fonts) fails in the
/// constructor with Failure(kRun) and the library's own text; a frame is never silently blank.
class Painter {
  public:
    Painter(const Scene& scene, const Motion& motion, const PainterOptions& options);
    ~Painter();
    Painter(Painter&&) noexcept;
    Painter& operator=(Painter&&) noexcept;

    /// Draws the instant `t` [s of the motion] into `out`, which is resized if need be; with the
    /// blur of the film's shutter around it.
    void paint(double t, Image& out);

    /// The next frame of a film: draws what differs from the one before, in the picture that the
    /// last call has left, and returns what that is; the pixels are those of paint(). Another
    /// picture, or one whose pixels lie elsewhere in memory, is drawn as a whole.
    ChangedParts paint_next(double t, Image& picture);

    /// Whether paint_next() finds nothing of the frame before that stays: under a camera that
    /// moves.
    bool draws_each_anew() const;

    /// Draws the balls of all `instants` [s, increasing, at least one] into one picture, as under a
    /// stroboscope: nearer ones in front, each sharp, with its own shadows. Clock, labels and
    /// trails are those of the last instant.
    void paint_strobe(const std::vector<double>& instants, Image& out);

    /// Renderer and version strings of the driver, for --stats and for failed goldens.
    std::string renderer() const;

    /// What is drawn and why, for --stats: shadows, markings, ruler, clock, labels, trail, ...
    std::map<std::string, DrawnEffect> effects() const;

    /// CPU seconds since construction, for --stats: of the calling thread and of the driver's own
    /// rasteriser threads (render/gl/driver_clock.h). Drawing includes the overlay and the set-up.
    double draw_cpu_s() const;
    double read_cpu_s() const;

  private:
    std::unique_ptr<Picture> picture_;
};

}  // namespace carom
