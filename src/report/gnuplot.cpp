#include "report/gnuplot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

#include "core/failure.h"
#include "core/temporary_folder.h"
#include "media/output_file.h"
#include "media/png.h"
#include "report/plot.h"

namespace carom {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_plotting(const std::string& message) {
    throw Failure(FailureKind::kRun, message);
}

/// Our own environment, but for what would change the plot.
std::vector<std::string> environment() {
    std::vector<std::string> variables = {"LC_ALL=C", "TZ=UTC0"};
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string_view text = *entry;
        const bool ours = text.starts_with("LC_") || text.starts_with("TZ=") ||
                          text.starts_with("LANG") || text.starts_with("GNUTERM") ||
                          text.starts_with("GNUPLOT") || text.starts_with("SOURCE_DATE_EPOCH");
        if (!ours) variables.emplace_back(text);
    }
    return variables;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> result;
    for (std::string& text : texts) result.push_back(text.data());
    result.push_back(nullptr);
    return result;
}

/// The finished program: its wait status, and what it wrote on standard error.
struct Finished {
    int status = 0;
    std::string errors;
};

class SpawnSettings {
  public:
    SpawnSettings(int error_write, int error_read) {
        posix_spawn_file_actions_init(&actions_);
        posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_adddup2(&actions_, error_write, STDERR_FILENO);
        posix_spawn_file_actions_addclose(&actions_, error_read);
        posix_spawn_file_actions_addclose(&actions_, error_write);
        // Interrupts are blocked in our own threads, and failing writes are not signals: the child
        // must feel both. gnuplot would not notice the latter.
        sigset_t none, ours;
        sigemptyset(&none);
        sigemptyset(&ours);
        sigaddset(&ours, SIGPIPE);
        sigaddset(&ours, SIGXFSZ);
        posix_spawnattr_init(&attributes_);
        posix_spawnattr_setsigmask(&attributes_, &none);
        posix_spawnattr_setsigdefault(&attributes_, &ours);
        posix_spawnattr_setpgroup(&attributes_, 0);  // a group of its own, to be ended with
        posix_spawnattr_setflags(
            &attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    }
    ~SpawnSettings() {
        posix_spawn_file_actions_destroy(&actions_);
        posix_spawnattr_destroy(&attributes_);
    }
    SpawnSettings(const SpawnSettings&) = delete;
    SpawnSettings& operator=(const SpawnSettings&) = delete;
    const posix_spawn_file_actions_t* actions() const { return &actions_; }
    const posix_spawnattr_t* attributes() const { return &attributes_; }

  private:
    posix_spawn_file_actions_t actions_{};
    posix_spawnattr_t attributes_{};
};

/// What the child says on standard error, to its end.
std::string read_all(int descriptor) {
    std::string text;
    std::array<char, 4096> block{};
    for (ssize_t n = 0; (n = read(descriptor, block.data(), block.size())) != 0;) {
        if (n < 0 && errno != EINTR) break;
        if (n > 0) text.append(block.data(), static_cast<std::size_t>(n));
    }
    return text;
}

Finished run(std::vector<std::string> arguments, const std::stop_token& stop) {
    std::array<int, 2> pipe{};
    if (pipe2(pipe.data(), O_CLOEXEC) != 0)
        fail_plotting(fmt::format("making a pipe to gnuplot: {}", std::strerror(errno)));
    const SpawnSettings settings(pipe[1], pipe[0]);
    std::vector<std::string> variables = environment();
    pid_t child = 0;
    const int error =
        posix_spawnp(&child, arguments.front().c_str(), settings.actions(), settings.attributes(),
                     pointers(arguments).data(), pointers(variables).data());
    close(pipe[1]);
    if (error != 0) {
        close(pipe[0]);
        if (error == ENOENT)
            fail_plotting(
                "gnuplot draws the plots and is not installed: apt-get install gnuplot-nox");
        fail_plotting(fmt::format("starting gnuplot: {}", std::strerror(error)));
    }
    Finished finished;
    {
        // Until the child is waited for nobody else has its number.
        const std::stop_callback end_child(stop, [child] { kill(-child, SIGKILL); });
        finished.errors = read_all(pipe[0]);
        close(pipe[0]);
        siginfo_t ended{};
        while (waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT) < 0 &&
               errno == EINTR) {
        }
    }
    while (waitpid(child, &finished.status, 0) < 0 && errno == EINTR) {
    }
    if (stop.stop_requested()) fail_plotting("interrupted while gnuplot was running");
    return finished;
}

/// The bytes of a plot that do not depend on the day, nor on the fonts of who looks at it.
std::string settled(std::string bytes, PlotFormat format) {
    if (format == PlotFormat::kPdf) {
        // cairo writes the time of day: (D:YYYYMMDDhhmmssZ). The length must stay, because a PDF
        // counts its bytes. The date is the paper's.
        static constexpr std::string_view kKey = "/CreationDate (D:", kDate = "20120601000000";
        const std::size_t at = bytes.find(kKey);
        if (at != std::string::npos && at + kKey.size() + kDate.size() <= bytes.size())
            bytes.replace(at + kKey.size(), kDate.size(), kDate);
    } else if (format == PlotFormat::kSvg) {
        static constexpr std::string_view kOne = "font-family=\"Inter\"",
                                          kMany =
                                              "font-family=\"Inter, Helvetica, Arial, sans-serif\"";
        for (std::size_t at = 0; (at = bytes.find(kOne, at)) != std::string::npos;
             at += kMany.size())
            bytes.replace(at, kOne.size(), kMany);
    }
    return bytes;
}

/// Whether the file has its end: gnuplot does not look whether what it wrote has reached the disk.
bool is_whole(const std::string& bytes, const std::string& path, PlotFormat format) {
    const auto ends_with = [&bytes](std::string_view end) {
        const std::size_t last = bytes.find_last_not_of(" \r\n");
        return last != std::string::npos &&
               std::string_view(bytes).substr(0, last + 1).ends_with(end);
    };
    if (format == PlotFormat::kSvg) return ends_with("</svg>");
    if (format == PlotFormat::kPdf) return ends_with("%%EOF");
    try {
        read_png(path);
    } catch (const Failure&) {
        return false;
    }
    return true;
}

/// Says what is wrong with a plot that is not whole. A disk without room is the user's to mend.
[[noreturn]] void fail_unfinished(const std::string& path, const std::string& drawn,
                                  std::size_t bytes) {
    throw Failure(
        FailureKind::kOutput,
        fmt::format("drawing {}: gnuplot wrote {} bytes of the plot to {} and no more: is "
                    "there room for temporary files (TMPDIR)?",
                    path, bytes, fs::path(drawn).parent_path().string()));
}

std::string read_whole(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

std::string gnuplot_version() {
    // It prints on standard error.
    const Finished finished = run(
        {"gnuplot", "-d", "-e", "print sprintf('%.1f.%s', GPVAL_VERSION, GPVAL_PATCHLEVEL)"}, {});
    if (finished.status != 0)
        fail_plotting(fmt::format("asking for its version: {}", finished.errors));
    return finished.errors.substr(0, finished.errors.find('\n'));
}

void run_gnuplot(const std::string& script, const std::string& attempt,
                 const std::stop_token& stop) {
    const TemporaryFolder folder(FailureKind::kRun);
    const std::string path = folder.file("script.gp");
    write_text_file(path, script, Durability::kUnsynced);
    const Finished finished = run({"gnuplot", "-d", path}, stop);
    if (WIFEXITED(finished.status) && WEXITSTATUS(finished.status) == 0) return;
    if (WIFSIGNALED(finished.status) && WTERMSIG(finished.status) == SIGXFSZ)
        throw Failure(FailureKind::kOutput,
                      fmt::format("{}: {} (ulimit -f)", attempt, std::strerror(EFBIG)));
    if (WIFSIGNALED(finished.status))
        fail_plotting(
            fmt::format("{}: gnuplot was ended by signal {}", attempt, WTERMSIG(finished.status)));
    fail_plotting(fmt::format("{}: gnuplot failed: {}", attempt, finished.errors));
}

void write_plot(const Plot& plot, const std::string& path, Existing existing,
                const std::stop_token& stop) {
    const std::optional<PlotFormat> format = plot_format_of(path);
    if (!format)
        throw Failure(FailureKind::kInput,
                      fmt::format("{}: a plot is a .svg, .png or .pdf file", path));
    const TemporaryFolder folder(FailureKind::kRun);
    const std::string drawn = folder.file("plot");
    run_gnuplot(gnuplot_script(plot, *format, drawn), "drawing " + path, stop);
    const std::string made = read_whole(drawn);
    if (!is_whole(made, drawn, *format)) fail_unfinished(path, drawn, made.size());
    const std::string bytes = settled(made, *format);
    write_text_file(path, bytes, Durability::kUnsynced, existing);
}

void require_gnuplot(const std::stop_token& stop) { run({"gnuplot", "--version"}, stop); }

}  // namespace carom
