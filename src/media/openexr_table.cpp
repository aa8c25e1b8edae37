#include "media/openexr_table.h"

#include <fmt/format.h>

#include <string>

namespace carom {

namespace {

OpenExr load_openexr() {
    // "30.5.1": the first number is that of the interface.
    const std::string version = OPENEXR_LIB_VERSION_STRING;
    const SharedLibrary library(
        fmt::format("libOpenEXRCore-{}_{}.so.{}", OPENEXR_VERSION_MAJOR, OPENEXR_VERSION_MINOR,
                    version.substr(0, version.find('.'))),
        fmt::format("EXR files need OpenEXR (package libopenexr-{}-{}-{})", OPENEXR_VERSION_MAJOR,
                    OPENEXR_VERSION_MINOR, version.substr(0, version.find('.'))));
    OpenExr table;
    CAROM_OPENEXR_FUNCTIONS(CAROM_FIND)
    return table;
}

}  // namespace

const OpenExr& openexr() {
    static const OpenExr table = load_openexr();
    return table;
}

}  // namespace carom
