// OSMesa's entry points as a table that is filled when the first context is made. The library
// brings LLVM; linked in, it would cost every command 15 ms before it begins.
#pragma once

#include <GL/osmesa.h>

#include "core/shared_library.h"

namespace carom {

/// Every function that carom calls: X(its name).
#define CAROM_OSMESA_FUNCTIONS(X) \
    X(OSMesaCreateContextAttribs) \
    X(OSMesaDestroyContext) X(OSMesaGetCurrentContext) X(OSMesaGetProcAddress) X(OSMesaMakeCurrent)

/// Each function under its own name.
struct OsMesa {
    CAROM_OSMESA_FUNCTIONS(CAROM_FUNCTION)
};

/// Loads the library at the first call; it stays. Failure(kRun) with the loader's own text if it is
/// missing. Safe from any thread.
const OsMesa& osmesa();

}  // namespace carom
