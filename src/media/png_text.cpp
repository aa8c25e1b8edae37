#include "media/png_text.h"

#include <cstddef>
#include <cstdint>

namespace carom {

namespace {

std::size_t big_endian(std::string_view four_bytes) {
    std::size_t value = 0;
    for (const char byte : four_bytes) value = value << 8 | static_cast<std::uint8_t>(byte);
    return value;
}

}  // namespace

std::string text_in_png(std::string_view bytes, std::string_view keyword) {
    constexpr std::size_t kSignature = 8, kAround = 12;  // length, name, checksum
    for (std::size_t at = kSignature; at + kAround <= bytes.size();) {
        const std::size_t size = big_endian(bytes.substr(at, 4));
        if (size > bytes.size() - at - kAround) break;
        const std::string_view name = bytes.substr(at + 4, 4), body = bytes.substr(at + 8, size);
        // As png_text_chunk() writes them: zeros stand between keyword and text.
        const std::size_t zeros = name == "tEXt" ? 1 : name == "iTXt" ? 5 : 0;
        if (zeros > 0 && body.starts_with(keyword) && size >= keyword.size() + zeros &&
            body.substr(keyword.size(), zeros) == std::string_view("\0\0\0\0\0", zeros))
            return std::string(body.substr(keyword.size() + zeros));
        at += size + kAround;
    }
    return "";
}

}  // namespace carom
