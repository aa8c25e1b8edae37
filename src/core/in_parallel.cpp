#include "core/in_parallel.h"

#include <algorithm>
#include <atomic>
#include <ctime>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace carom {

namespace {

double thread_cpu_s() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

double in_parallel(int count, const std::function<void(int)>& work) {
    std::atomic<int> next = 0;
    std::mutex mutex;
    std::exception_ptr failure;
    double others_s = 0;
    const auto take = [&] {
        try {
            for (int i = next++; i < count; i = next++) work(i);
        } catch (...) {
            next = count;
            const std::lock_guard lock(mutex);
            if (!failure) failure = std::current_exception();
        }
    };
    {
        constexpr int kMostThreads = 16;
        const int processors = static_cast<int>(std::thread::hardware_concurrency());
        std::vector<std::jthread> others;
        try {
            for (int i = 1; i < std::min({count, processors, kMostThreads}); ++i)
                others.emplace_back([&] {
                    take();
                    const std::lock_guard lock(mutex);
                    others_s += thread_cpu_s();
                });
        } catch (const std::system_error&) {
            // With those that there are.
        }
        take();
    }
    if (failure) std::rethrow_exception(failure);
    return others_s;
}

}  // namespace carom
