#include "cli/standard_error.h"

#include <poll.h>
#include <unistd.h>

#include <cerrno>

namespace carom {

void write_standard_error(std::string_view text) noexcept {
    while (!text.empty()) {
        const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
        if (written > 0) {
            text.remove_prefix(static_cast<std::size_t>(written));
        } else if (errno == EAGAIN) {  // whoever shares the terminal may have made it non-blocking
            pollfd room{STDERR_FILENO, POLLOUT, 0};
            if (::poll(&room, 1, -1) < 0 && errno != EINTR) return;
        } else if (written == 0 || errno != EINTR) {
            return;
        }
    }
}

void write_standard_error_at_once(std::string_view text) noexcept {
    pollfd room{STDERR_FILENO, POLLOUT, 0};
    if (::poll(&room, 1, 0) != 1 || (room.revents & POLLOUT) == 0) return;
    // A pipe with room takes a line whole (PIPE_BUF).
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
}

}  // namespace carom
