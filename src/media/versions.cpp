#include "media/versions.h"

#include <fmt/format.h>
#include <png.h>

#include "media/libav_table.h"

namespace carom {

namespace {

std::string text(unsigned version) {
    return fmt::format("{}.{}.{}", version >> 16, version >> 8 & 255, version & 255);
}

}  // namespace

std::map<std::string, std::string> media_versions() {
    return {{"libpng", PNG_LIBPNG_VER_STRING},
            {"libavcodec", text(libav().avcodec_version())},
            {"libavformat", text(libav().avformat_version())},
            {"libswscale", text(libav().swscale_version())}};
}

}  // namespace carom
