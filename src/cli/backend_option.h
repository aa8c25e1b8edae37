// --backend: which library gives OpenGL.
#pragma once

namespace CLI {
class App;
}

namespace carom {

/// Adds --backend, which CAROM_BACKEND in the environment stands for; parsing it chooses the back
/// end of the process (render/gl/backend.h).
void add_backend_option(CLI::App& command);

}  // namespace carom
