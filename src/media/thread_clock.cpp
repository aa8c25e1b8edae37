#include "media/thread_clock.h"

#include <dirent.h>
#include <pthread.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <fstream>
#include <memory>

namespace carom {

namespace {

double seconds(clockid_t clock) {
    timespec time = {};
    if (clock_gettime(clock, &time) != 0) return 0.0;
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The kernel's clock of one thread of this process: the complement of its id above three bits that
/// say "of a thread" (4) and "time on the processor" (2); see MAKE_THREAD_CPUCLOCK in Linux's
/// posix-timers_types.h. It is part of the system call's interface and does not change.
clockid_t clock_of(int thread_id) {
    const unsigned bits = (~static_cast<unsigned>(thread_id) << 3) | 4U | 2U;
    return static_cast<clockid_t>(bits);
}

struct CloseFolder {
    void operator()(DIR* folder) const { closedir(folder); }
};

}  // namespace

double calling_thread_cpu_s() { return seconds(CLOCK_THREAD_CPUTIME_ID); }

ForeignThreads::Naming::Naming(const std::string& name) {
    std::array<char, 16> before = {};
    pthread_getname_np(pthread_self(), before.data(), before.size());
    before_ = before.data();
    pthread_setname_np(pthread_self(), name.c_str());
}

ForeignThreads::Naming::~Naming() { pthread_setname_np(pthread_self(), before_.c_str()); }

void ForeignThreads::find(const std::string& name) {
    clocks_.clear();
    const std::string tasks = "/proc/self/task/";
    const std::unique_ptr<DIR, CloseFolder> folder(opendir(tasks.c_str()));
    if (!folder) return;
    while (const dirent* entry = readdir(folder.get())) {
        const std::string text = entry->d_name;
        int id = 0;
        const auto read = std::from_chars(text.data(), text.data() + text.size(), id);
        if (read.ec != std::errc() || id == gettid()) continue;
        std::string its_name;
        std::getline(std::ifstream(tasks + text + "/comm"), its_name);
        if (its_name == name) clocks_.push_back(clock_of(id));
    }
}

double ForeignThreads::total_s() const {
    double sum = 0;
    for (const clockid_t clock : clocks_) sum += seconds(clock);
    return sum;
}

}  // namespace carom
