#include "render/gl/egl_table.h"

#include "core/shared_library.h"

namespace carom {

namespace {

Egl load() {
    const SharedLibrary library("libEGL.so.1", "pictures need EGL (package libegl1)");
    Egl table;
#define CAROM_EGL_FIND(name) library.find(table.name, #name);
    CAROM_EGL_FUNCTIONS(CAROM_EGL_FIND)
#undef CAROM_EGL_FIND
    table.folder = library.folder();
    return table;
}

}  // namespace

const Egl& egl() {
    static const Egl table = load();
    return table;
}

}  // namespace carom
