// What each back end would draw with on this machine.
#pragma once

#include <string>

#include "render/gl/backend.h"

namespace carom {

struct BackendProbe {
    bool found = false;
    std::string text;  ///< as OffscreenContext::renderer() has it; where there is none, why
};

/// Makes a context of this back end, draws and reads back, in a process of its own: there one back
/// end does not meet the other, and may crash. Call it before this process has drawn anything.
BackendProbe probe_backend(BackendChoice choice);

}  // namespace carom
