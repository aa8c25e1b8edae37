#include "media/film_text.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>

#include "core/failure.h"

namespace carom {

namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

void put_big_endian(std::string& bytes, std::uint64_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255);
}

/// A comment extension: blocks of up to 255 bytes behind their lengths, and an empty one (GIF89a,
/// 24).
std::string gif_comment(const std::string& text) {
    constexpr std::size_t kMostInBlock = 255;
    std::string bytes = "\x21\xFE";
    for (std::size_t at = 0; at < text.size(); at += kMostInBlock) {
        const std::string block = text.substr(at, kMostInBlock);
        bytes += static_cast<char>(block.size());
        bytes += block;
    }
    return bytes + '\0';
}

/// Replaces the last bytes of a file, which must be `end`, by `text` + `end`.
void insert_before_end(const std::string& path, const std::string& name, const std::string& end,
                       const std::string& text) {
    const auto fail = [&](const std::string& why) {
        throw Failure(FailureKind::kOutput, fmt::format("cannot write '{}': {}", name, why));
    };
    std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "r+be"));
    if (!file) fail(std::strerror(errno));
    const auto back = static_cast<long>(end.size());
    std::string found(end.size(), '\0');
    if (std::fseek(file.get(), -back, SEEK_END) != 0 ||
        std::fread(found.data(), 1, found.size(), file.get()) != found.size() || found != end)
        fail("its end is not where it belongs");
    const std::string all = text + end;
    if (std::fseek(file.get(), -back, SEEK_END) != 0 ||
        std::fwrite(all.data(), 1, all.size(), file.get()) != all.size() ||
        std::fclose(file.release()) != 0)
        fail(std::strerror(errno));
}

}  // namespace

std::string png_text_chunk(const std::string& keyword, const std::string& text) {
    const bool ascii = std::all_of(text.begin(), text.end(),
                                   [](char c) { return static_cast<unsigned char>(c) < 128; });
    // iTXt: not compressed, in no language, no translated keyword.
    const std::string content = (ascii ? "tEXt" : "iTXt") + keyword +
                                (ascii ? std::string(1, '\0') : std::string(5, '\0')) + text;
    std::string bytes;
    put_big_endian(bytes, content.size() - 4);
    bytes += content;
    put_big_endian(bytes, crc32(0, reinterpret_cast<const Bytef*>(content.data()),
                                static_cast<uInt>(content.size())));
    return bytes;
}

void append_film_text(const std::string& path, const std::string& name, const FilmFormat& format,
                      const std::string& title, const std::string& comment) {
    if (title.empty() && comment.empty()) return;
    if (format.extension == "gif") {
        const std::string between = title.empty() || comment.empty() ? "" : "; ";
        insert_before_end(path, name, ";", gif_comment(title + between + comment));
    } else if (format.extension == "apng") {
        std::string chunks;
        if (!title.empty()) chunks += png_text_chunk("Title", title);
        if (!comment.empty()) chunks += png_text_chunk("Comment", comment);
        insert_before_end(path, name, std::string("\0\0\0\0IEND\xAE\x42\x60\x82", 12), chunks);
    }
}

}  // namespace carom
