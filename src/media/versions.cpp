#include "media/versions.h"

#include <fmt/format.h>
#include <png.h>

#include "core/failure.h"
#include "media/libav_table.h"
#include "media/openexr_table.h"

namespace carom {

namespace {

std::string text(unsigned version) {
    return fmt::format("{}.{}.{}", version >> 16, version >> 8 & 255, version & 255);
}

std::map<std::string, std::string> libav_versions() {
    try {
        return {{"ffmpeg", libav().av_version_info()},
                {"libavcodec", text(libav().avcodec_version())},
                {"libavformat", text(libav().avformat_version())},
                {"libswscale", text(libav().swscale_version())}};
    } catch (const Failure& failure) {
        return {{"libavcodec", fmt::format("none: {}", failure.what())}};
    }
}

}  // namespace

namespace {

std::string openexr_version() {
    try {
        int major = 0, minor = 0, patch = 0;
        const char* extra = nullptr;
        openexr().exr_get_library_version(&major, &minor, &patch, &extra);
        return fmt::format("{}.{}.{}", major, minor, patch);
    } catch (const Failure& failure) {
        return fmt::format("none: {}", failure.what());
    }
}

}  // namespace

std::map<std::string, std::string> media_versions() {
    std::map<std::string, std::string> versions = libav_versions();
    versions["libpng"] = PNG_LIBPNG_VER_STRING;
    versions["openexr"] = openexr_version();
    return versions;
}

std::vector<FoundCodec> found_codecs() {
    std::vector<FoundCodec> found;
    try {
        for (const FilmCodec& codec : film_codecs())
            found.push_back(
                {&codec, libav().avcodec_find_encoder_by_name(codec.encoder) != nullptr});
    } catch (const Failure&) {
        // media_versions() says why.
    }
    return found;
}

}  // namespace carom
