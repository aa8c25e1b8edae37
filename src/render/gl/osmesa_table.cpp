#include "render/gl/osmesa_table.h"

namespace carom {

namespace {

OsMesa load_osmesa() {
    // As its interface is numbered since Mesa 7.
    const SharedLibrary library("libOSMesa.so.8", "pictures need OSMesa (package libosmesa6)");
    OsMesa table;
    CAROM_OSMESA_FUNCTIONS(CAROM_FIND)
    return table;
}

}  // namespace

const OsMesa& osmesa() {
    static const OsMesa table = load_osmesa();
    return table;
}

}  // namespace carom
