// Text from outside in HTML and XML.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace carom {

/// What may stand between tags and in quotes of both: &, <, > and quotes as entities; what would
/// move a cursor, turn the direction of reading or is no UTF-8 as in core/readable.h.
/// A text of more than `longest` bytes loses its middle.
std::string escaped(std::string_view text, std::size_t longest = 1000);

/// RFC 4648, section 4.
std::string base64(std::string_view bytes);

}  // namespace carom
