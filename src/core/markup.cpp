#include "core/markup.h"

#include <array>
#include <cstdint>

#include "core/readable.h"

namespace carom {

std::string escaped(std::string_view text, std::size_t longest) {
    std::string result;
    for (const char c : readable(text, longest)) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            case '\'':
                result += "&#39;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string result;
    result.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::array<std::uint32_t, 3> three{};
        for (std::size_t k = 0; k < 3 && i + k < bytes.size(); ++k)
            three[k] = static_cast<unsigned char>(bytes[i + k]);
        const std::uint32_t bits = three[0] << 16U | three[1] << 8U | three[2];
        for (std::size_t k = 0; k < 4; ++k)
            result += i + k <= bytes.size() ? kDigits[bits >> (18 - 6 * k) & 63U] : '=';
    }
    return result;
}

}  // namespace carom
