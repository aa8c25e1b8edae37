#include "render/versions.h"

#include <cairo.h>

#include "render/draw2d/typeface.h"

namespace carom {

std::string font_name() { return overlay_typeface().name(); }

std::map<std::string, std::string> render_versions() { return {{"cairo", cairo_version_string()}}; }

}  // namespace carom
