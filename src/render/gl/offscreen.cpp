#include "render/gl/offscreen.h"

#include <fmt/core.h>

#include <atomic>
#include <exception>
#include <system_error>

#include "core/failure.h"
#include "render/gl/backend.h"
#include "render/gl/driver_environment.h"

#ifdef __SANITIZE_ADDRESS__
// OSMesa (22.3) keeps what describes the contexts' buffers when it destroys the contexts, and EGL
// its display. There is one such hook per program.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libOSMesa\nleak:libEGL\nleak:swrast_dri\nleak:libgallium\n";
}
#endif

namespace carom {

namespace {

std::atomic<bool> quick_compile = false;

std::string text_of(const Gl& gl, GLenum what) {
    const GLubyte* text = gl.GetString(what);
    return text == nullptr ? std::string("unknown") : reinterpret_cast<const char*>(text);
}

}  // namespace

class OffscreenContext::Impl {
  public:
    explicit Impl(const GlContext* sharing) {
        const GlBackend& backend = gl_backend();  // a loader reads the environment as well
        if (sharing == nullptr) set_driver_environment(quick_compile);
        context_ = backend.make_context(sharing);
        make_current();
        gl_ = Gl::load(backend.loader());
        check_version();
        if (const std::string why = why_refused(text_of(gl_, GL_RENDERER)); !why.empty())
            throw Failure(FailureKind::kRun, why);
        check_driver_threads();
    }

    void make_current() { context_->make_current(); }
    void release() { context_->release(); }
    const Gl& gl() const { return gl_; }
    const GlContext* context() const { return context_.get(); }

  private:
    // A back end may return a pointer for names that do not exist: only the version tells.
    void check_version() const {
        GLint major = 0, minor = 0;
        gl_.GetIntegerv(GL_MAJOR_VERSION, &major);
        gl_.GetIntegerv(GL_MINOR_VERSION, &minor);
        if (major > kGlMajor || (major == kGlMajor && minor >= kGlMinor)) return;
        throw Failure(FailureKind::kRun,
                      fmt::format("OpenGL {}.{} is needed, but the driver has \"{}\"", kGlMajor,
                                  kGlMinor, text_of(gl_, GL_VERSION)));
    }

    std::unique_ptr<GlContext> context_;
    Gl gl_;
};

void prefer_quick_compile() { quick_compile = true; }

DriverPreload::DriverPreload() {
    try {
        thread_ = std::jthread([] {
            try {
                gl_backend();
            } catch (const std::exception&) {
                // The first context says it.
            }
        });
    } catch (const std::system_error&) {
        // No thread: the first context loads it.
    }
}

OffscreenContext::OffscreenContext() : impl_(std::make_unique<Impl>(nullptr)) {}
OffscreenContext::OffscreenContext(const OffscreenContext& sharing)
    : impl_(std::make_unique<Impl>(sharing.impl_->context())) {}
OffscreenContext::~OffscreenContext() = default;
OffscreenContext::OffscreenContext(OffscreenContext&&) noexcept = default;
OffscreenContext& OffscreenContext::operator=(OffscreenContext&&) noexcept = default;

void OffscreenContext::make_current() { impl_->make_current(); }
void OffscreenContext::release() { impl_->release(); }
const Gl& OffscreenContext::gl() const { return impl_->gl(); }
std::string OffscreenContext::renderer() const {
    return fmt::format("{}, {}, {}", text_of(gl(), GL_RENDERER), text_of(gl(), GL_VERSION),
                       gl_backend().name());
}

}  // namespace carom
