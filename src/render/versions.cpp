#include "render/versions.h"

#include <cairo.h>

namespace carom {

std::map<std::string, std::string> render_versions() { return {{"cairo", cairo_version_string()}}; }

}  // namespace carom
