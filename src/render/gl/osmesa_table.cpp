#include "render/gl/osmesa_table.h"

#include "core/shared_library.h"

namespace carom {

namespace {

OsMesa load() {
    // As its interface is numbered since Mesa 7.
    const SharedLibrary library("libOSMesa.so.8", "pictures need OSMesa (package libosmesa6)");
    OsMesa table;
#define CAROM_OSMESA_FIND(name) library.find(table.name, #name);
    CAROM_OSMESA_FUNCTIONS(CAROM_OSMESA_FIND)
#undef CAROM_OSMESA_FIND
    return table;
}

}  // namespace

const OsMesa& osmesa() {
    static const OsMesa table = load();
    return table;
}

}  // namespace carom
