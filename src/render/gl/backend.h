// The libraries that give contexts of OpenGL without a display, behind one interface: OSMesa, which
// Mesa has had until 25.0, and EGL on Mesa's platform "surfaceless". On one Mesa both draw the same
// pixels.
#pragma once

#include <memory>

#include "render/gl/gl.h"

namespace carom {

/// One context of OpenGL 3.3 core. Destroying it must not leave it current in another thread.
class GlContext {
  public:
    virtual ~GlContext() = default;
    /// Cheap when it is current already. Failure(kRun) if the library refuses.
    virtual void make_current() = 0;
    /// No context is current in this thread any more, if this one was.
    virtual void release() = 0;
};

class GlBackend {
  public:
    virtual ~GlBackend() = default;
    virtual const char* name() const = 0;  ///< for people: "OSMesa"
    /// `sharing`: a context of the same back end whose textures, buffers and programs it shares, or
    /// null. Failure(kRun) with the library's own reason.
    virtual std::unique_ptr<GlContext> make_context(const GlContext* sharing) const = 0;
    /// Of the context that is current.
    virtual Gl::Loader loader() const = 0;
};

/// kAuto: OSMesa where its library can be loaded, else EGL.
enum class BackendChoice { kAuto, kOsMesa, kEgl };

/// To be called before gl_backend(); kAuto without.
void choose_backend(BackendChoice choice);

/// The one that this process draws with: its library is loaded by the first call and stays, since
/// two of them would take each other's current context for their own. Safe from any thread.
/// Failure(kRun) that names the packages where there is none.
const GlBackend& gl_backend();

/// Each loads its library; Failure(kRun) that names the package.
std::unique_ptr<GlBackend> load_osmesa_backend();
std::unique_ptr<GlBackend> load_egl_backend();

}  // namespace carom
