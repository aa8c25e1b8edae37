// Contexts through EGL on Mesa's platform "surfaceless": no display, no window, no device needed
// (https://registry.khronos.org/EGL/extensions/MESA/EGL_MESA_platform_surfaceless.txt).
#include <fmt/core.h>

#include <array>
#include <string_view>

#include "core/failure.h"
#include "core/shared_library.h"
#include "render/gl/backend.h"
#include "render/gl/egl_table.h"

namespace carom {

namespace {

const char* error_name(EGLint error) {
    switch (error) {
        case EGL_NOT_INITIALIZED:
            return "EGL_NOT_INITIALIZED";
        case EGL_BAD_ACCESS:
            return "EGL_BAD_ACCESS";
        case EGL_BAD_ALLOC:
            return "EGL_BAD_ALLOC";
        case EGL_BAD_ATTRIBUTE:
            return "EGL_BAD_ATTRIBUTE";
        case EGL_BAD_CONFIG:
            return "EGL_BAD_CONFIG";
        case EGL_BAD_CONTEXT:
            return "EGL_BAD_CONTEXT";
        case EGL_BAD_DISPLAY:
            return "EGL_BAD_DISPLAY";
        case EGL_BAD_MATCH:
            return "EGL_BAD_MATCH";
        case EGL_BAD_PARAMETER:
            return "EGL_BAD_PARAMETER";
        default:
            return "unknown error";
    }
}

/// "EGL <what>: EGL_BAD_ALLOC (0x3003)"
Failure egl_failure(std::string_view what) {
    const EGLint error = egl().eglGetError();
    return {FailureKind::kRun, fmt::format("EGL {}: {} ({:#x})", what, error_name(error), error)};
}

bool has_word(const char* words, std::string_view word) {
    if (words == nullptr) return false;
    for (std::string_view rest = words; !rest.empty();) {
        const std::size_t end = rest.find(' ');
        if (rest.substr(0, end) == word) return true;
        rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    }
    return false;
}

/// Loads what the first context would load, with LLVM: as DriverPreload has another thread do.
/// The loader's text where that fails. (Another maker's EGL has nothing of this, and a Mesa
/// elsewhere finds its driver itself.)
const std::string& load_driver() {
    static const std::string trouble = [] {
        // The driver is linked with Mesa's EGL since 24.2, and was a plug-in before.
        const std::string mesa = SharedLibrary::try_to_load("libEGL_mesa.so.0");
        const std::string plug_in = SharedLibrary::try_to_load(egl().folder + "/dri/swrast_dri.so");
        return mesa.empty() ? plug_in : mesa;
    }();
    return trouble;
}

EGLDisplay open_display() {
    // What an older or foreign EGL lacks it would answer with its default display, or nothing.
    const char* client = egl().eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    constexpr std::string_view kPackages =
        "(packages libegl-mesa0 and libgl1-mesa-dri; or OSMesa, package libosmesa6)";
    if (!has_word(client, "EGL_MESA_platform_surfaceless"))
        throw Failure(FailureKind::kRun,
                      fmt::format("EGL has no driver that draws without a display {}: {}",
                                  kPackages, load_driver()));
    EGLDisplay display =
        egl().eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY)
        throw egl_failure(fmt::format("gives no display without a window {}", kPackages));
    if (egl().eglInitialize(display, nullptr, nullptr) != EGL_TRUE)
        throw egl_failure(fmt::format("finds no driver {}: {}", kPackages, load_driver()));
    const char* extensions = egl().eglQueryString(display, EGL_EXTENSIONS);
    for (const char* needed : {"EGL_KHR_no_config_context", "EGL_KHR_surfaceless_context"})
        if (!has_word(extensions, needed))
            throw Failure(FailureKind::kRun, fmt::format("the driver of EGL has no {}", needed));
    return display;
}

/// One for all contexts, which share through it; it stays open until the process ends.
EGLDisplay the_display() {
    static EGLDisplay display = open_display();
    return display;
}

/// Which API contexts are of is a setting of each thread.
void bind_api() {
    if (egl().eglBindAPI(EGL_OPENGL_API) != EGL_TRUE)
        throw egl_failure("has no OpenGL, only OpenGL ES");
}

class EglContext : public GlContext {
  public:
    explicit EglContext(EGLContext sharing) : display_(the_display()) {
        bind_api();
        const std::array<EGLint, 7> attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                                  kGlMajor,
                                                  EGL_CONTEXT_MINOR_VERSION,
                                                  kGlMinor,
                                                  EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                  EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                  EGL_NONE};
        context_ = egl().eglCreateContext(display_, EGL_NO_CONFIG_KHR, sharing, attributes.data());
        if (context_ == EGL_NO_CONTEXT)
            throw egl_failure(
                fmt::format("gives no OpenGL {}.{} core context", kGlMajor, kGlMinor));
    }
    ~EglContext() override {
        // One that is current somewhere lives on until it is released there.
        if (egl().eglGetCurrentContext() == context_) unset_current();
        egl().eglDestroyContext(display_, context_);
    }
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

    void make_current() override {
        bind_api();
        if (egl().eglGetCurrentContext() == context_) return;
        if (egl().eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE)
            throw egl_failure("cannot make its context current");
    }
    void release() override {
        bind_api();
        if (egl().eglGetCurrentContext() == context_) unset_current();
    }

    EGLContext context() const { return context_; }

  private:
    void unset_current() {
        egl().eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }

    EGLDisplay display_;
    EGLContext context_ = EGL_NO_CONTEXT;
};

class EglBackend : public GlBackend {
  public:
    EglBackend() { load_driver(); }
    const char* name() const override { return "EGL"; }
    std::unique_ptr<GlContext> make_context(const GlContext* sharing) const override {
        const auto* other = static_cast<const EglContext*>(sharing);
        return std::make_unique<EglContext>(other == nullptr ? EGL_NO_CONTEXT : other->context());
    }
    Gl::Loader loader() const override { return egl().eglGetProcAddress; }
};

}  // namespace

std::unique_ptr<GlBackend> load_egl_backend() { return std::make_unique<EglBackend>(); }

}  // namespace carom
