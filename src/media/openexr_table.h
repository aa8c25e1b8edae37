// The entry points of OpenEXR's core library as a table that is filled when the first file of that
// kind is made.
#pragma once

#include <OpenEXRConfig.h>
#include <openexr.h>

#include "core/shared_library.h"

namespace carom {

// clang-format off
/// Every function that carom calls: X(its name).
#define CAROM_OPENEXR_FUNCTIONS(X)                                                                \
    X(exr_add_channel) X(exr_add_part) X(exr_encoding_choose_default_routines)                    \
    X(exr_encoding_destroy) X(exr_encoding_initialize) X(exr_encoding_run)                        \
    X(exr_encoding_update) X(exr_finish) X(exr_get_default_error_message)                         \
    X(exr_get_library_version) X(exr_initialize_required_attr_simple) X(exr_set_tile_descriptor)  \
    X(exr_start_write) X(exr_write_header) X(exr_write_tile_chunk) X(exr_write_tile_chunk_info)
// clang-format on

/// Each function under its own name.
struct OpenExr {
    CAROM_OPENEXR_FUNCTIONS(CAROM_FUNCTION)
};

/// Loads the library at the first call, of the version that the headers belong to; it stays.
/// Failure(kRun) with the loader's own text if it is missing. Safe from any thread.
const OpenExr& openexr();

}  // namespace carom
