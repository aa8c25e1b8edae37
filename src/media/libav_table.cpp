#include "media/libav_table.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <string>

#include "core/failure.h"

namespace carom {

namespace {

std::string loader_message() {
    const char* text = dlerror();
    return text == nullptr ? "unknown error" : text;
}

/// Never closed: its functions are called until the program ends.
void* open_library(const char* name, int major) {
    const std::string file = fmt::format("lib{}.so.{}", name, major);
    void* library = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (library == nullptr)
        throw Failure(FailureKind::kRun,
                      fmt::format("films need FFmpeg, but its library {} cannot be loaded: {}",
                                  file, loader_message()));
    return library;
}

template <class Function>
void find(Function& function, void* library, const char* name) {
    function = reinterpret_cast<Function>(dlsym(library, name));
    if (function == nullptr)
        throw Failure(FailureKind::kRun, fmt::format("FFmpeg's libraries have no function {}: {}",
                                                     name, loader_message()));
}

Libav load() {
    Libav table;
    void* library = nullptr;
#define CAROM_LIBAV_FIND(name) find(table.name, library, #name);
    library = open_library("avutil", LIBAVUTIL_VERSION_MAJOR);
    CAROM_AVUTIL_FUNCTIONS(CAROM_LIBAV_FIND)
    library = open_library("avcodec", LIBAVCODEC_VERSION_MAJOR);
    CAROM_AVCODEC_FUNCTIONS(CAROM_LIBAV_FIND)
    library = open_library("avformat", LIBAVFORMAT_VERSION_MAJOR);
    CAROM_AVFORMAT_FUNCTIONS(CAROM_LIBAV_FIND)
    library = open_library("swscale", LIBSWSCALE_VERSION_MAJOR);
    CAROM_SWSCALE_FUNCTIONS(CAROM_LIBAV_FIND)
#undef CAROM_LIBAV_FIND
    return table;
}

}  // namespace

const Libav& libav() {
    static const Libav table = load();
    return table;
}

}  // namespace carom
