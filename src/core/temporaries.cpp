#include "core/temporaries.h"

#include <chrono>
#include <filesystem>
#include <mutex>
#include <set>
#include <system_error>

namespace carom::temporaries {

namespace {

/// Whoever holds the lock may wait for a disk that does not answer; the end of the process does not
/// wait for that as well.
constexpr std::chrono::milliseconds kMostWaiting{50};

struct Registry {
    std::timed_mutex mutex;
    std::set<std::string> paths;
};

Registry& registry() {
    static Registry all;
    return all;
}

}  // namespace

std::string add(const std::function<std::string()>& make) {
    Registry& all = registry();
    const std::lock_guard lock(all.mutex);
    const std::string path = make();
    if (!path.empty()) all.paths.insert(path);
    return path;
}

void forget(const std::string& path) noexcept {
    Registry& all = registry();
    const std::lock_guard lock(all.mutex);
    all.paths.erase(path);
}

void remove_for_good() noexcept {
    Registry& all = registry();
    std::unique_lock lock(all.mutex, kMostWaiting);
    if (!lock.owns_lock()) return;
    for (const std::string& path : all.paths) {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    lock.release();  // for good: nobody makes another one
}

}  // namespace carom::temporaries
