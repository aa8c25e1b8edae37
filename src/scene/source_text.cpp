#include "scene/source_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/readable.h"
#include "scene/document.h"

namespace carom {

namespace {

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

/// Control characters that YAML does not allow in a document (YAML 1.2.2, production c-printable).
bool is_forbidden(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7F;
}

std::string without_carriage_returns(std::string_view bytes) {
    std::string text;
    text.reserve(bytes.size());
    for (std::size_t i = 0; i < bytes.size(); ++i)
        if (bytes[i] != '\r' || i + 1 >= bytes.size() || bytes[i + 1] != '\n') text += bytes[i];
    return text;
}

}  // namespace

std::optional<SourceText> SourceText::check(std::string_view bytes, const std::string& file,
                                            Diagnostics& diagnostics) {
    const auto refuse = [&](SourceMark mark, std::string message) {
        diagnostics.add({Severity::kError, file, mark, std::move(message)});
        return std::nullopt;
    };
    if (bytes.size() > kMaxDocumentBytes)
        return refuse({}, fmt::format("the file has {} bytes; a scene may have at most {} (16 MiB)",
                                      bytes.size(), kMaxDocumentBytes));
    if (bytes.substr(0, 2) == "\xFF\xFE" || bytes.substr(0, 2) == "\xFE\xFF")
        return refuse({1, 1}, "the file is UTF-16; save it as UTF-8");
    if (bytes.substr(0, 3) == "\xEF\xBB\xBF") bytes.remove_prefix(3);

    SourceText source;
    source.text_ = without_carriage_returns(bytes);
    source.line_starts_ = {0};
    for (std::size_t i = 0; i < source.text_.size(); ++i) {
        if (source.text_[i] == '\n') source.line_starts_.push_back(i + 1);
        if (is_continuation(source.text_[i])) source.continuations_.push_back(i);
    }
    int line = 0;
    for (std::size_t i = 0, start = 0; i < source.text_.size();) {
        const std::size_t length = utf8_length(source.text_, i);
        const int column = static_cast<int>(i - start);
        if (length == 0)
            return refuse(source.mark(line, column),
                          "this byte is not UTF-8; save the file as UTF-8");
        if (is_forbidden(source.text_[i]))
            return refuse(source.mark(line, column),
                          fmt::format("control character 0x{:02x} in the text; remove it",
                                      static_cast<unsigned char>(source.text_[i])));
        if (source.text_[i] == '\n') {
            ++line;
            start = i + 1;
        }
        i += length;
    }
    return source;
}

SourceMark SourceText::mark(int line, int byte_column) const {
    if (line < 0 || byte_column < 0) return {};
    const std::size_t row = std::min(static_cast<std::size_t>(line), line_starts_.size() - 1);
    const std::size_t begin = line_starts_[row];
    const std::size_t next =
        row + 1 < line_starts_.size() ? line_starts_[row + 1] - 1 : text_.size();
    const std::size_t end = std::min(begin + static_cast<std::size_t>(byte_column), next);
    const auto skipped = std::lower_bound(continuations_.begin(), continuations_.end(), end) -
                         std::lower_bound(continuations_.begin(), continuations_.end(), begin);
    const std::size_t characters = end - begin - static_cast<std::size_t>(skipped);
    return {static_cast<int>(row) + 1, static_cast<int>(characters) + 1};
}

}  // namespace carom
