// The font that travels inside the program (src/render/fonts).
#pragma once

#include <span>

namespace carom {

/// An OpenType file: Inter, weight Medium.
std::span<const unsigned char> embedded_font();

}  // namespace carom
