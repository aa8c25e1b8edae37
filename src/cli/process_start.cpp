#include "cli/process_start.h"

#include <fcntl.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>

namespace carom {

void open_standard_descriptors() {
    // Opened for the other direction, so that using them is an error; messages may be lost.
    constexpr int kModes[] = {O_WRONLY, O_RDONLY, O_RDWR};
    for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor) {
        if (::fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) continue;
        // The lowest free number is this one.
        [[maybe_unused]] const int opened = ::open("/dev/null", kModes[descriptor]);
    }
}

void let_writing_fail() {
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

void share_the_heap_where_it_is_limited() {
    rlimit limit{};
    if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        mallopt(M_ARENA_MAX, 1);
}

void quiet_libraries() { ::setenv("SVT_LOG", "1", 0); }

}  // namespace carom
