#include "media/libav_table.h"

#include <fmt/format.h>

namespace carom {

namespace {

SharedLibrary open_library(const char* name, int major) {
    return SharedLibrary(fmt::format("lib{}.so.{}", name, major), "films need FFmpeg");
}

Libav load_libav() {
    Libav table;
    {
        const SharedLibrary library = open_library("avutil", LIBAVUTIL_VERSION_MAJOR);
        CAROM_AVUTIL_FUNCTIONS(CAROM_FIND)
    }
    {
        const SharedLibrary library = open_library("avcodec", LIBAVCODEC_VERSION_MAJOR);
        CAROM_AVCODEC_FUNCTIONS(CAROM_FIND)
    }
    {
        const SharedLibrary library = open_library("avformat", LIBAVFORMAT_VERSION_MAJOR);
        CAROM_AVFORMAT_FUNCTIONS(CAROM_FIND)
    }
    {
        const SharedLibrary library = open_library("swscale", LIBSWSCALE_VERSION_MAJOR);
        CAROM_SWSCALE_FUNCTIONS(CAROM_FIND)
    }
    return table;
}

}  // namespace

const Libav& libav() {
    static const Libav table = load_libav();
    return table;
}

}  // namespace carom
