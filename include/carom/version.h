// The version of these headers, and that of the library that runs.
#pragma once

#include <carom/export.h>

#define CAROM_VERSION_MAJOR 0
#define CAROM_VERSION_MINOR 1
#define CAROM_VERSION_PATCH 0

CAROM_NAMESPACE_BEGIN

/// "0.1.0"
CAROM_API const char* version();

CAROM_NAMESPACE_END
