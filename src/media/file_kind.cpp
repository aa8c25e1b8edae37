#include "media/file_kind.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string_view>

#include "core/failure.h"

namespace carom {

namespace {

using namespace std::string_view_literals;
namespace fs = std::filesystem;

constexpr std::string_view kPng = "\x89PNG\r\n\x1A\n"sv;

/// A picture's first bytes; `inner` stands at `at` besides, where the first ones say too little.
struct Signature {
    std::string_view start;
    const char* name;
    std::size_t at = 0;
    std::string_view inner{};
};

// Of each format's own specification. GIF is no still picture here: FFmpeg reads it as a film.
constexpr std::array kPictures = {
    Signature{"\xFF\xD8\xFF"sv, "JPEG"},
    Signature{"BM"sv, "BMP", 6, "\0\0\0\0"sv},
    Signature{"II*\0"sv, "TIFF"},
    Signature{"MM\0*"sv, "TIFF"},
    Signature{"RIFF"sv, "WebP", 8, "WEBP"sv},
    Signature{"\x76\x2F\x31\x01"sv, "OpenEXR"},
    Signature{"\0\0\0\x0CJXL "sv, "JPEG XL"},
    Signature{"\xFF\x0A"sv, "JPEG XL"},
    Signature{"8BPS"sv, "Photoshop"},
    Signature{"\0\0\0"sv, "AVIF", 4, "ftypavif"sv},
    Signature{"\0\0\0"sv, "HEIF", 4, "ftyphei"sv},
    Signature{"P5"sv, "PGM"},
    Signature{"P6"sv, "PPM"},
    Signature{"<svg"sv, "SVG"},
    Signature{"<?xml"sv, "SVG"},
    Signature{"%PDF"sv, "PDF"},
};

/// True where an animation control chunk comes before the pixels (PNG, third edition, 11.3.6.1).
bool is_animated(std::string_view png) {
    constexpr std::size_t kHead = 8, kAround = 12;  // length and type before; checksum behind
    for (std::size_t at = kPng.size(); at + kHead <= png.size();) {
        const std::string_view type = png.substr(at + 4, 4);
        if (type == "acTL") return true;
        if (type == "IDAT") return false;
        std::size_t length = 0;
        for (std::size_t i = 0; i < 4; ++i)
            length = length << 8U | static_cast<unsigned char>(png[at + i]);
        at += length + kAround;
    }
    return false;
}

FileContent content_of(std::string_view bytes) {
    if (bytes.empty()) return {PictureFileKind::kEmpty};
    if (bytes.starts_with("version https://git-lfs")) return {PictureFileKind::kLfsPointer};
    if (bytes.starts_with(kPng))
        return {is_animated(bytes) ? PictureFileKind::kOther : PictureFileKind::kPng};
    for (const Signature& signature : kPictures)
        if (bytes.starts_with(signature.start) && bytes.size() >= signature.at &&
            bytes.substr(signature.at).starts_with(signature.inner))
            return {PictureFileKind::kOtherPicture, signature.name};
    return {PictureFileKind::kOther};
}

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

FileContent file_content(const std::string& path) {
    std::error_code error;
    // What is read from a pipe is gone from it: there the name has to do.
    if (fs::exists(path, error) && !fs::is_regular_file(path, error) &&
        !fs::is_directory(path, error))
        return {fs::path(path).extension() == ".png" ? PictureFileKind::kPng
                                                     : PictureFileKind::kOther};
    const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rbe"));
    std::array<char, 4096> bytes{};
    std::size_t size = 0;
    errno = 0;
    if (file) size = std::fread(bytes.data(), 1, bytes.size(), file.get());
    if (!file || std::ferror(file.get()) != 0)
        throw Failure(FailureKind::kInput,
                      fmt::format("cannot read '{}': {}", path, std::strerror(errno)));
    return content_of({bytes.data(), size});
}

}  // namespace carom
