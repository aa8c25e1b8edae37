#include "media/versions.h"

#include <fmt/format.h>
#include <png.h>

#include "core/failure.h"
#include "media/libav_table.h"

namespace carom {

namespace {

std::string text(unsigned version) {
    return fmt::format("{}.{}.{}", version >> 16, version >> 8 & 255, version & 255);
}

std::map<std::string, std::string> libav_versions() {
    try {
        return {{"libavcodec", text(libav().avcodec_version())},
                {"libavformat", text(libav().avformat_version())},
                {"libswscale", text(libav().swscale_version())}};
    } catch (const Failure& failure) {
        return {{"libavcodec", fmt::format("none: {}", failure.what())}};
    }
}

}  // namespace

std::map<std::string, std::string> media_versions() {
    std::map<std::string, std::string> versions = libav_versions();
    versions["libpng"] = PNG_LIBPNG_VER_STRING;
    return versions;
}

}  // namespace carom
