// Text from outside, as it may be shown to a person.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace carom {

/// A name, a path or another program's words in a message. What could move the cursor, colour the
/// terminal, end the line or turn the direction of reading is written as an escape (`\n`, `\x1b`,
/// `\u202e`), bytes that are no UTF-8 as `\xNN`; a text of more than `longest` bytes loses its
/// middle.
std::string readable(std::string_view text, std::size_t longest = 200);

/// The same for a whole message, which may hold several names.
std::string readable_message(std::string_view text);

/// Length in bytes of the well-formed UTF-8 sequence at `i`, or 0 (The Unicode Standard, table
/// 3-7).
std::size_t utf8_length(std::string_view text, std::size_t i);

}  // namespace carom
