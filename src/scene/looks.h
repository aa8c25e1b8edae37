// Colours and markings that a scene gets where it names none.
#pragma once

#include <string>

#include "scene/scene.h"

namespace carom {

/// "#rrggbb" or "#rgb", checked already.
Color parse_color(const std::string& text);

/// The style of a word of the table of keys; an unknown one is a Bug.
LookStyle parse_style(const std::string& word);
/// The word of the table of keys that means the style.
const char* style_word(LookStyle style);

/// "#rrggbb", rounded to the nearest.
std::string color_text(const Color& color);

/// A style in its own two colours: what a look has that names only a style, and what presets have.
Look style_look(LookStyle style);

/// Planes: a light, calm checker, so that the balls stand out and motion can be judged.
Look default_plane_look();

/// All surfaces but planes: neutral grey.
Look default_solid_look();

/// Balls without preset: plain colours that repeat after kPaletteSize.
Look palette_look(int index);
inline constexpr int kPaletteSize = 7;

}  // namespace carom
