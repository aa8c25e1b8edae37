#include "render/gl/backend_probe.h"

#include <fmt/core.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>

#include "core/failure.h"
#include "render/gl/offscreen.h"

namespace carom {

namespace {

constexpr char kFound = '+', kMissing = '-';

/// Draws one colour into a small framebuffer.
void require_drawing(const Gl& gl) {
    constexpr int kEdge = 8;
    constexpr std::array<std::uint8_t, 4> kWanted = {51, 102, 153, 255};
    const GlTexture color =
        make_texture(gl, GL_RGBA8, kEdge, kEdge, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    const GlFramebuffer frame = make_framebuffer(gl, "a test", {&color});
    gl.Viewport(0, 0, kEdge, kEdge);
    gl.ClearColor(0.2F, 0.4F, 0.6F, 1);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    std::array<std::uint8_t, 4> pixel{};
    gl.ReadPixels(kEdge / 2, kEdge / 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
    gl.check("drawing a test");
    if (pixel != kWanted)
        throw Failure(FailureKind::kRun, "the driver draws blank pictures and reports no error");
}

std::string found_in_this_process(BackendChoice choice) {
    // A process that was forked off one with threads had better make none.
    ::setenv("LP_NUM_THREADS", "0", 1);
    ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    choose_backend(choice);
    try {
        OffscreenContext context;
        context.make_current();
        require_drawing(context.gl());
        return kFound + context.renderer();
    } catch (const std::exception& error) {
        return kMissing + std::string(error.what());
    }
}

void write_all(int descriptor, const std::string& text) {
    for (std::size_t done = 0; done < text.size();) {
        const ssize_t written = ::write(descriptor, text.data() + done, text.size() - done);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return;
        done += static_cast<std::size_t>(written);
    }
}

std::string read_all(int descriptor) {
    std::string text;
    std::array<char, 4096> part{};
    for (;;) {
        const ssize_t count = ::read(descriptor, part.data(), part.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return text;
        text.append(part.data(), static_cast<std::size_t>(count));
    }
}

}  // namespace

BackendProbe probe_backend(BackendChoice choice) {
    int pipe[2];
    if (::pipe(pipe) != 0) return {false, std::strerror(errno)};
    const pid_t parent = ::getpid();
    const pid_t child = ::fork();
    if (child == 0) {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        ::close(pipe[0]);
        if (::getppid() == parent) write_all(pipe[1], found_in_this_process(choice));
        ::_exit(0);
    }
    const int no_child = errno;
    ::close(pipe[1]);
    const std::string text = child < 0 ? "" : read_all(pipe[0]);
    ::close(pipe[0]);
    if (child < 0) return {false, std::strerror(no_child)};
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (!text.empty()) return {text.front() == kFound, text.substr(1)};
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    return {false, fmt::format("the driver crashes: {}", ::strsignal(signal))};
}

}  // namespace carom
