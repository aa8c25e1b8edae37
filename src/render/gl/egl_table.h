// EGL's entry points as a table that is filled when the first context is made.
#pragma once

#define EGL_NO_X11  // or its header asks for that of X
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <string>

#include "core/shared_library.h"

namespace carom {

// clang-format off
/// Every function that carom calls: X(its name).
#define CAROM_EGL_FUNCTIONS(X)                                                                    \
    X(eglBindAPI) X(eglCreateContext) X(eglDestroyContext) X(eglGetCurrentContext)                \
    X(eglGetError) X(eglGetPlatformDisplay) X(eglGetProcAddress) X(eglInitialize)                 \
    X(eglMakeCurrent) X(eglQueryString)
// clang-format on

/// Each function under its own name.
struct Egl {
    CAROM_EGL_FUNCTIONS(CAROM_FUNCTION)
    std::string folder;  ///< of the library
};

/// Loads the library (GLVND's, which asks those of the drivers) at the first call; it stays.
/// Failure(kRun) with the loader's own text if it is missing or older than EGL 1.5. Safe from any
/// thread.
const Egl& egl();

}  // namespace carom
