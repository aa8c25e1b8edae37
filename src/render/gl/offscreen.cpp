#include "render/gl/offscreen.h"

#include <fmt/core.h>

#include <array>
#include <atomic>
#include <exception>
#include <system_error>

#include "core/failure.h"
#include "render/gl/driver_environment.h"
#include "render/gl/osmesa_table.h"

#ifdef __SANITIZE_ADDRESS__
// OSMesa (22.3) keeps what describes the contexts' buffers when it destroys the contexts. There is
// one such hook per program.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa\n"; }
#endif

namespace carom {

namespace {

constexpr int kDummyEdge = 16;  ///< pixels; OSMesa wants some memory, no drawing goes there
constexpr int kMajor = 3, kMinor = 3;

std::atomic<bool> quick_compile = false;

std::string text_of(const Gl& gl, GLenum what) {
    const GLubyte* text = gl.GetString(what);
    return text == nullptr ? std::string("unknown") : reinterpret_cast<const char*>(text);
}

}  // namespace

class OffscreenContext::Impl {
  public:
    explicit Impl(OSMesaContext sharing) {
        if (sharing == nullptr) {
            osmesa();  // a loader reads the environment as well
            set_driver_environment(quick_compile);
        }
        const std::array<int, 9> attributes = {OSMESA_FORMAT,
                                               OSMESA_RGBA,
                                               OSMESA_PROFILE,
                                               OSMESA_CORE_PROFILE,
                                               OSMESA_CONTEXT_MAJOR_VERSION,
                                               kMajor,
                                               OSMESA_CONTEXT_MINOR_VERSION,
                                               kMinor,
                                               0};
        context_ = osmesa().OSMesaCreateContextAttribs(attributes.data(), sharing);
        if (context_ == nullptr)
            throw Failure(FailureKind::kRun,
                          fmt::format("OSMesa gives no OpenGL {}.{} core context", kMajor, kMinor));
        try {
            make_current();
            gl_ = Gl::load(osmesa().OSMesaGetProcAddress);
            check_version();
            check_driver_threads();
        } catch (...) {
            osmesa().OSMesaDestroyContext(context_);
            throw;
        }
    }
    ~Impl() { osmesa().OSMesaDestroyContext(context_); }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    void make_current() {
        if (osmesa().OSMesaGetCurrentContext() == context_) return;
        if (osmesa().OSMesaMakeCurrent(context_, dummy_.data(), GL_UNSIGNED_BYTE, kDummyEdge,
                                       kDummyEdge) != GL_TRUE)
            throw Failure(FailureKind::kRun, "OSMesa cannot make its context current");
    }

    void release() {
        if (osmesa().OSMesaGetCurrentContext() == context_)
            osmesa().OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
    }

    const Gl& gl() const { return gl_; }
    OSMesaContext context() const { return context_; }

  private:
    // OSMesaGetProcAddress returns a pointer for names that do not exist: only the version tells.
    void check_version() const {
        GLint major = 0, minor = 0;
        gl_.GetIntegerv(GL_MAJOR_VERSION, &major);
        gl_.GetIntegerv(GL_MINOR_VERSION, &minor);
        if (major > kMajor || (major == kMajor && minor >= kMinor)) return;
        throw Failure(FailureKind::kRun,
                      fmt::format("OpenGL {}.{} is needed, but the driver has \"{}\"", kMajor,
                                  kMinor, text_of(gl_, GL_VERSION)));
    }

    OSMesaContext context_ = nullptr;
    std::array<unsigned char, kDummyEdge * kDummyEdge * 4> dummy_{};
    Gl gl_;
};

void prefer_quick_compile() { quick_compile = true; }

DriverPreload::DriverPreload() {
    try {
        thread_ = std::jthread([] {
            try {
                osmesa();
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
    return text_of(gl(), GL_RENDERER) + ", " + text_of(gl(), GL_VERSION);
}

}  // namespace carom
