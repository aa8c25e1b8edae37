#include "media/versions.h"

#include <fmt/format.h>
#include <png.h>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

namespace carom {

namespace {

std::string text(unsigned version) {
    return fmt::format("{}.{}.{}", version >> 16, version >> 8 & 255, version & 255);
}

}  // namespace

std::map<std::string, std::string> media_versions() {
    return {{"libpng", PNG_LIBPNG_VER_STRING},
            {"libavcodec", text(avcodec_version())},
            {"libavformat", text(avformat_version())},
            {"libswscale", text(swscale_version())}};
}

}  // namespace carom
