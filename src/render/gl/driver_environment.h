// What Mesa's driver reads of the environment, and what of that is carom's own choice: pictures
// must not depend on variables that somebody has set for games or for debugging.
#pragma once

#include <string>
#include <string_view>

namespace carom {

/// To be called before a context is made. llvmpipe is the driver, with the versions and extensions
/// that it has (under EGL a GPU's, where the user says LIBGL_ALWAYS_SOFTWARE=0); without threads
/// where the system gives none, and with quick instead of good code where `quick_compile` says so.
/// Other settings of llvmpipe's stay. Failure(kRun) where the user asks for softpipe, whose pixels
/// are others.
void set_driver_environment(bool quick_compile);

/// Why pictures are not drawn by a driver that calls itself so (GL_RENDERER); "" where they are.
std::string why_refused(std::string_view renderer);

/// After the first context. Failure(kRun) where the driver has fewer threads than it counts on: it
/// would wait for the missing ones for ever.
void check_driver_threads();

}  // namespace carom
