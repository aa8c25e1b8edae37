#include "cli/distinct_files.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <optional>

#include "core/failure.h"

namespace carom {

namespace {

namespace fs = std::filesystem;

enum class Use { kRead, kWritten };

std::optional<struct stat> status_of(const std::string& path, Use use) {
    struct stat info = {};
    const int standard = use == Use::kRead ? STDIN_FILENO : STDOUT_FILENO;
    const int error = path == "-" ? ::fstat(standard, &info) : ::stat(path.c_str(), &info);
    return error == 0 ? std::optional(info) : std::nullopt;
}

bool is_null_device(const struct stat& info) {
    struct stat null = {};
    return S_ISCHR(info.st_mode) && ::stat("/dev/null", &null) == 0 && info.st_rdev == null.st_rdev;
}

/// Where a path leads that leads to nothing yet.
fs::path target_of(const std::string& path) {
    constexpr int kMostLinks = 40;  // as the kernel counts before it says ELOOP
    std::error_code error;
    fs::path target = path;
    for (int i = 0; i < kMostLinks; ++i) {
        const fs::path next = fs::read_symlink(target, error);
        if (error) break;
        target = next.is_absolute() ? next : target.parent_path() / next;
    }
    const fs::path whole = fs::weakly_canonical(fs::absolute(target, error), error);
    return error ? target : whole;
}

bool are_one(const NamedFile& a, Use use_a, const NamedFile& b, Use use_b) {
    if (a.path.empty() || b.path.empty()) return false;
    const bool both_written = use_a == use_b;
    if (a.path == "-" && b.path == "-") return both_written;
    const auto info_a = status_of(a.path, use_a), info_b = status_of(b.path, use_b);
    if (info_a && info_b) {
        if (is_null_device(*info_a)) return false;
        // A terminal or a socket may well be read and written.
        if (!both_written && !S_ISREG(info_a->st_mode)) return false;
        return info_a->st_dev == info_b->st_dev && info_a->st_ino == info_b->st_ino;
    }
    if (info_a || info_b || a.path == "-" || b.path == "-") return false;
    return target_of(a.path) == target_of(b.path);
}

std::string text_of(const NamedFile& file) { return fmt::format("{} {}", file.option, file.path); }

}  // namespace

bool are_one_file(const std::string& a, const std::string& b) {
    return are_one({"", a}, Use::kWritten, {"", b}, Use::kWritten);
}

void require_distinct(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs) {
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j)
            if (are_one(outputs[j], Use::kWritten, outputs[i], Use::kWritten))
                throw Failure(FailureKind::kInput,
                              fmt::format("{} and {} are one file: each needs a name of its own",
                                          text_of(outputs[j]), text_of(outputs[i])));
        for (const NamedFile& input : inputs)
            if (are_one(input, Use::kRead, outputs[i], Use::kWritten))
                throw Failure(FailureKind::kInput,
                              fmt::format("{} is {}, which is read: the output needs a name of its "
                                          "own",
                                          text_of(outputs[i]), text_of(input)));
    }
}

}  // namespace carom
