// Texts made small for a page, whose reader's browser unpacks them.
#pragma once

#include <string>
#include <string_view>

namespace carom {

/// RFC 1952, without name or time: equal texts give equal bytes.
std::string gzip(std::string_view text);

}  // namespace carom
