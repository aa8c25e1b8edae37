#include "render/gl/backend.h"

#include <fmt/core.h>

#include <atomic>

#include "core/failure.h"

namespace carom {

namespace {

std::atomic<BackendChoice> chosen = BackendChoice::kAuto;

std::unique_ptr<GlBackend> load_either() {
    std::string no_osmesa;
    try {
        return load_osmesa_backend();
    } catch (const Failure& failure) {
        no_osmesa = failure.what();
        // One that is there and cannot be loaded, as for want of memory, is no reason for another.
        if (no_osmesa.find("No such file") == std::string::npos) throw;
    }
    try {
        return load_egl_backend();
    } catch (const Failure& failure) {
        throw Failure(
            FailureKind::kRun,
            fmt::format("pictures need OSMesa (package libosmesa6) or EGL (packages libegl1 and "
                        "libgl1-mesa-dri): {}; {}",
                        no_osmesa, failure.what()));
    }
}

std::unique_ptr<GlBackend> load(BackendChoice choice) {
    switch (choice) {
        case BackendChoice::kOsMesa:
            return load_osmesa_backend();
        case BackendChoice::kEgl:
            return load_egl_backend();
        case BackendChoice::kAuto:
            return load_either();
    }
    return nullptr;
}

}  // namespace

void choose_backend(BackendChoice choice) { chosen = choice; }

const GlBackend& gl_backend() {
    static const std::unique_ptr<GlBackend> backend = load(chosen);
    return *backend;
}

}  // namespace carom
