// Contexts through OSMesa, Mesa's off-screen library.
#include <fmt/core.h>

#include <array>

#include "core/failure.h"
#include "render/gl/backend.h"
#include "render/gl/osmesa_table.h"

namespace carom {

namespace {

constexpr int kDummyEdge = 16;  ///< pixels; OSMesa wants some memory, no drawing goes there

class OsMesaContext : public GlContext {
  public:
    explicit OsMesaContext(OSMesaContext sharing) {
        const std::array<int, 9> attributes = {OSMESA_FORMAT,
                                               OSMESA_RGBA,
                                               OSMESA_PROFILE,
                                               OSMESA_CORE_PROFILE,
                                               OSMESA_CONTEXT_MAJOR_VERSION,
                                               kGlMajor,
                                               OSMESA_CONTEXT_MINOR_VERSION,
                                               kGlMinor,
                                               0};
        context_ = osmesa().OSMesaCreateContextAttribs(attributes.data(), sharing);
        if (context_ == nullptr)
            throw Failure(
                FailureKind::kRun,
                fmt::format("OSMesa gives no OpenGL {}.{} core context", kGlMajor, kGlMinor));
    }
    ~OsMesaContext() override { osmesa().OSMesaDestroyContext(context_); }
    OsMesaContext(const OsMesaContext&) = delete;
    OsMesaContext& operator=(const OsMesaContext&) = delete;

    void make_current() override {
        if (osmesa().OSMesaGetCurrentContext() == context_) return;
        if (osmesa().OSMesaMakeCurrent(context_, dummy_.data(), GL_UNSIGNED_BYTE, kDummyEdge,
                                       kDummyEdge) != GL_TRUE)
            throw Failure(FailureKind::kRun, "OSMesa cannot make its context current");
    }
    void release() override {
        if (osmesa().OSMesaGetCurrentContext() == context_)
            osmesa().OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
    }

    OSMesaContext context() const { return context_; }

  private:
    OSMesaContext context_ = nullptr;
    std::array<unsigned char, kDummyEdge * kDummyEdge * 4> dummy_{};
};

class OsMesaBackend : public GlBackend {
  public:
    OsMesaBackend() { osmesa(); }
    const char* name() const override { return "OSMesa"; }
    std::unique_ptr<GlContext> make_context(const GlContext* sharing) const override {
        const auto* other = static_cast<const OsMesaContext*>(sharing);
        return std::make_unique<OsMesaContext>(other == nullptr ? nullptr : other->context());
    }
    // Gives a pointer for names that do not exist: only the version tells.
    Gl::Loader loader() const override { return osmesa().OSMesaGetProcAddress; }
};

}  // namespace

std::unique_ptr<GlBackend> load_osmesa_backend() { return std::make_unique<OsMesaBackend>(); }

}  // namespace carom
