// The bytes of a scene file before anything parses them: encoding and line ends.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.h"

namespace carom {

/// Text that is safe to parse: UTF-8 without byte order mark, lines ended by '\n' alone.
class SourceText {
  public:
    /// Refuses other encodings, control characters and oversized files: null, with the reason in
    /// `diagnostics`.
    static std::optional<SourceText> check(std::string_view bytes, const std::string& file,
                                           Diagnostics& diagnostics);

    const std::string& text() const { return text_; }

    /// A place as people count it, from a parser that counts bytes from 0: lines and characters
    /// from 1, kept inside the file.
    SourceMark mark(int line, int byte_column) const;

  private:
    std::string text_;
    std::vector<std::size_t> line_starts_;    ///< byte offsets into text_
    std::vector<std::size_t> continuations_;  ///< byte offsets of bytes that begin no character
};

}  // namespace carom
