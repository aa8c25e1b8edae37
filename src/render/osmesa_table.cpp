#include "render/osmesa_table.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <string>

#include "core/failure.h"

namespace carom {

namespace {

constexpr const char* kFile = "libOSMesa.so.8";  // as its interface is numbered since Mesa 7

std::string loader_message() {
    const char* text = dlerror();
    return text == nullptr ? "unknown error" : text;
}

template <class Function>
void find(Function& function, void* library, const char* name) {
    function = reinterpret_cast<Function>(dlsym(library, name));
    if (function == nullptr)
        throw Failure(FailureKind::kRun,
                      fmt::format("{} has no function {}: {}", kFile, name, loader_message()));
}

OsMesa load() {
    // Never closed: its functions are called until the program ends.
    void* library = dlopen(kFile, RTLD_LAZY | RTLD_LOCAL);
    if (library == nullptr)
        throw Failure(FailureKind::kRun, fmt::format("pictures need OSMesa, but its library {} "
                                                     "cannot be loaded: {}",
                                                     kFile, loader_message()));
    OsMesa table;
#define CAROM_OSMESA_FIND(name) find(table.name, library, #name);
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
