#include "render/gl/egl_table.h"

namespace carom {

namespace {

Egl load_egl() {
    const SharedLibrary library("libEGL.so.1", "pictures need EGL (package libegl1)");
    Egl table;
    CAROM_EGL_FUNCTIONS(CAROM_FIND)
    table.folder = library.folder();
    return table;
}

}  // namespace

const Egl& egl() {
    static const Egl table = load_egl();
    return table;
}

}  // namespace carom
