#include "media/libav_table.h"

#include <fmt/format.h>

#include "core/shared_library.h"

namespace carom {

namespace {

SharedLibrary open_library(const char* name, int major) {
    return SharedLibrary(fmt::format("lib{}.so.{}", name, major), "films need FFmpeg");
}

Libav load() {
    const SharedLibrary avutil = open_library("avutil", LIBAVUTIL_VERSION_MAJOR);
    const SharedLibrary avcodec = open_library("avcodec", LIBAVCODEC_VERSION_MAJOR);
    const SharedLibrary avformat = open_library("avformat", LIBAVFORMAT_VERSION_MAJOR);
    const SharedLibrary swscale = open_library("swscale", LIBSWSCALE_VERSION_MAJOR);
    Libav table;
#define CAROM_LIBAV_FIND(name) library->find(table.name, #name);
    const SharedLibrary* library = &avutil;
    CAROM_AVUTIL_FUNCTIONS(CAROM_LIBAV_FIND)
    library = &avcodec;
    CAROM_AVCODEC_FUNCTIONS(CAROM_LIBAV_FIND)
    library = &avformat;
    CAROM_AVFORMAT_FUNCTIONS(CAROM_LIBAV_FIND)
    library = &swscale;
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
