// Texts inside PNG files.
#pragma once

#include <string>
#include <string_view>

namespace carom {

/// The first text of a PNG file's bytes with this keyword (tEXt, or iTXt that is not compressed);
/// empty where it has none, or is no PNG.
std::string text_in_png(std::string_view bytes, std::string_view keyword);

}  // namespace carom
