// An OpenGL context without a display, through the back end that the process has chosen
// (backend.h).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "render/gl/gl.h"

namespace carom {

/// Asks the driver to compile shaders quickly rather than well, for a process that draws one
/// picture of ordinary size: to be called before its first context. The pixels are the same.
void prefer_quick_compile();

/// Loads the driver in another thread, which takes as long as a scene's simulation does: to be made
/// before that. A driver that cannot be loaded, also for want of a thread, is said by the first
/// context.
class DriverPreload {
  public:
    DriverPreload();

  private:
    std::jthread thread_;
};

/// Owns one context of OpenGL 3.3 core, which has no framebuffer that is of use: carom draws into
/// its own framebuffer objects.
/// One thread at a time; whoever hands it to another thread, or leaves it to be destroyed there,
/// releases it first. Several contexts may live in one process.
class OffscreenContext {
  public:
    /// Failure(kRun) if there is no context, its version is below 3.3, its driver is one whose
    /// pixels differ (why_refused()), or an entry point is missing.
    OffscreenContext();
    /// Shares textures, buffers and programs of the other, for use in another thread; vertex arrays
    /// and framebuffers are its own. What one has drawn the other sees after glFinish.
    explicit OffscreenContext(const OffscreenContext& sharing);
    ~OffscreenContext();
    OffscreenContext(OffscreenContext&&) noexcept;
    OffscreenContext& operator=(OffscreenContext&&) noexcept;

    /// Cheap when it is current already; call it before every use of GL.
    void make_current();
    /// No context is current in this thread any more.
    void release();
    const Gl& gl() const;
    /// For example "llvmpipe (LLVM 15.0.6, 256 bits), 4.5 (Core Profile) Mesa 22.3.6, OSMesa".
    std::string renderer() const;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

/// What pictures are drawn with: painters of one thread may share it, and with it the programs.
struct DrawingContexts {
    OffscreenContext main;
    std::optional<OffscreenContext> second;  ///< of another thread, made when first needed
};

}  // namespace carom
