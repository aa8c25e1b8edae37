#include "render/gl/driver_environment.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <latch>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include "core/failure.h"

namespace carom {

namespace {

/// llvmpipe makes no more in any release that is in use.
constexpr unsigned kMostThreads = 16;

/// How long a new thread may take to run first, on a machine that is busy.
constexpr std::chrono::seconds kPatience{5};

/// They pretend other versions or extensions than the driver has (it crashes where shaders then do
/// not compile), or leave out parts of drawing.
constexpr std::array kForeign = {"MESA_GL_VERSION_OVERRIDE",
                                 "MESA_GLES_VERSION_OVERRIDE",
                                 "MESA_GLSL_VERSION_OVERRIDE",
                                 "MESA_EXTENSION_OVERRIDE",
                                 "MESA_LOADER_DRIVER_OVERRIDE",
                                 "MESA_DEBUG",
                                 "LP_PERF"};

/// Whether the system gives so many threads at once.
bool can_make(unsigned count) {
    std::latch made(1);
    std::vector<std::jthread> threads;
    bool all = true;
    try {
        for (unsigned i = 0; i < count; ++i) threads.emplace_back([&made] { made.wait(); });
    } catch (const std::system_error&) {
        all = false;
    }
    made.count_down();
    return all;
}

/// How many threads llvmpipe is told to make.
unsigned wanted_threads() {
    const char* text = std::getenv("LP_NUM_THREADS");
    return text == nullptr ? 0 : static_cast<unsigned>(std::max(std::atoi(text), 0));
}

/// Those of this process that carry the driver's name; none where the system does not tell.
std::optional<unsigned> threads_of_driver() {
    std::error_code error;
    unsigned found = 0;
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task", error)) {
        std::ifstream file(task.path() / "comm");
        std::string name;
        std::getline(file, name);
        found += name.find("llvmpipe") != std::string::npos;
    }
    if (error) return std::nullopt;
    return found;
}

}  // namespace

void set_driver_environment(bool quick_compile) {
    const char* driver = std::getenv("GALLIUM_DRIVER");
    if (driver != nullptr && std::string_view(driver) == "softpipe")
        throw Failure(FailureKind::kRun,
                      "GALLIUM_DRIVER=softpipe: its pixels differ from llvmpipe's, with which "
                      "carom draws; unset GALLIUM_DRIVER");
    ::setenv("GALLIUM_DRIVER", "llvmpipe", 1);
    // EGL asks for a GPU first: it draws only where the user says so, since its pixels are others.
    ::setenv("LIBGL_ALWAYS_SOFTWARE", "1", 0);
    ::setenv("EGL_LOG_LEVEL", "fatal", 0);  // what fails is said by our own message
    for (const char* name : kForeign) ::unsetenv(name);
    if (std::getenv("LP_NUM_THREADS") == nullptr) {
        const unsigned cores = std::clamp(std::thread::hardware_concurrency(), 1u, kMostThreads);
        const unsigned threads = cores > 1 && can_make(cores) ? cores : 0;
        ::setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);
    }
    // llvmpipe leaves out optimization: a quarter of a still's time. A setting of the user's stays.
    if (quick_compile) ::setenv("GALLIVM_PERF", "nopt", 0);
}

std::string why_refused(std::string_view renderer) {
    constexpr std::array kRefused = {"softpipe", "Software Rasterizer"};  // the latter: swrast
    for (const char* refused : kRefused)
        if (renderer.find(refused) != std::string_view::npos)
            return fmt::format(
                "the driver is {}, whose pixels differ from llvmpipe's, with which carom draws; "
                "install a Mesa that has llvmpipe (package libgl1-mesa-dri or libosmesa6)",
                renderer);
    return "";
}

void check_driver_threads() {
    const unsigned wanted = std::min(wanted_threads(), kMostThreads);
    // A thread takes its name when it first runs, which may be after this one looks.
    const auto end = std::chrono::steady_clock::now() + kPatience;
    std::optional<unsigned> found = threads_of_driver();
    while (found && *found < wanted && std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        found = threads_of_driver();
    }
    if (!found || *found >= wanted) return;
    throw Failure(
        FailureKind::kRun,
        fmt::format("the driver could make {} of its {} threads; the system gives no more "
                    "(LP_NUM_THREADS=0 draws without)",
                    *found, wanted));
}

}  // namespace carom
