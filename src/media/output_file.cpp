#include "media/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include "core/failure.h"
#include "core/temporaries.h"

namespace carom {

namespace {

namespace fs = std::filesystem;

constexpr const char* kTemporary = ".tmp";  // then the process's number

[[noreturn]] void fail(const std::string& action, const std::string& path, int error) {
    throw Failure(FailureKind::kOutput,
                  fmt::format("cannot {} '{}': {}", action, path, std::strerror(error)));
}

std::string folder_of(const std::string& path) {
    const std::string folder = fs::path(path).parent_path().string();
    return folder.empty() ? "." : folder;
}

/// Where `path` leads when it is a symbolic link, also one that leads nowhere yet.
std::string follow_links(const std::string& path) {
    constexpr int kMostLinks = 40;  // as the kernel counts before it says ELOOP
    struct stat info = {};
    // A device or pipe is opened by its first name: /dev/stdout leads to one that cannot be opened.
    if (::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode)) return path;
    fs::path target = path;
    std::error_code error;
    for (int i = 0; i < kMostLinks; ++i) {
        const fs::path next = fs::read_symlink(target, error);
        if (error) return target.string();  // not a link
        target = next.is_absolute() ? next : target.parent_path() / next;
    }
    fail("write", path, ELOOP);
}

/// An owned file descriptor.
class Descriptor {
  public:
    explicit Descriptor(int fd) : fd_(fd) {}
    ~Descriptor() {
        if (fd_ >= 0) ::close(fd_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int get() const { return fd_; }
    int close() { return ::close(std::exchange(fd_, -1)); }

  private:
    int fd_;
};

/// The longest name in the folder of `path`, in bytes.
std::size_t longest_name(const std::string& path) {
    constexpr std::size_t kUsual = 255;
    const long longest = ::pathconf(folder_of(path).c_str(), _PC_NAME_MAX);
    return longest > 0 ? static_cast<std::size_t>(longest) : kUsual;
}

/// `stem` + `middle` + `extension` with as much of the stem, and then of the extension, as fits.
std::string fitting_name(std::string stem, const std::string& middle, std::string extension,
                         std::size_t longest) {
    const auto cut = [&](std::string& text) {
        const std::size_t size = stem.size() + middle.size() + extension.size();
        std::size_t kept = text.size() - std::min(text.size(), size > longest ? size - longest : 0);
        // Never inside a character of UTF-8.
        while (kept > 0 && kept < text.size() &&
               (static_cast<unsigned char>(text[kept]) & 0xC0U) == 0x80U)
            --kept;
        text.resize(kept);
    };
    cut(stem);
    cut(extension);
    return stem + middle + extension;
}

/// Renames, unless something stands under the new name: EEXIST then, and 0 when done.
int rename_to_free_name(const std::string& from, const std::string& to) {
    if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return 0;
    if (errno != EINVAL && errno != ENOSYS) return errno;
    // A file system without it: a second name that must be new, then the first one goes.
    if (::link(from.c_str(), to.c_str()) == 0) return ::unlink(from.c_str()) == 0 ? 0 : errno;
    if (errno != EPERM && errno != EOPNOTSUPP && errno != ENOSYS) return errno;
    // One without links either: another program may come between these two lines.
    struct stat info = {};
    if (::lstat(to.c_str(), &info) == 0) return EEXIST;
    return ::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

/// Gives the new file what belongs to the one that it replaces.
void take_over_mode(const Descriptor& file, const std::string& target) {
    constexpr mode_t kPermissions = 0777;
    struct stat old = {}, own = {};
    if (::stat(target.c_str(), &old) != 0 || ::fstat(file.get(), &own) != 0) return;
    // Only root gives files away; whoever may replace another's file gets it as his own.
    const bool owned = (old.st_uid == own.st_uid && old.st_gid == own.st_gid) ||
                       ::fchown(file.get(), old.st_uid, old.st_gid) == 0 ||
                       ::fchown(file.get(), static_cast<uid_t>(-1), old.st_gid) == 0;
    // Of another group: what the old group might do is nobody's business.
    const mode_t mode = old.st_mode & (owned ? kPermissions : kPermissions & ~mode_t{070});
    ::fchmod(file.get(), mode);
}

/// Reserves a name beside `target` that no other process or thread has.
std::string create_temporary(const std::string& path, const std::string& target) {
    constexpr int kMostAttempts = 10000;
    const fs::path name = fs::path(target).filename();
    const std::size_t longest = longest_name(target);
    for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
        const std::string count = attempt == 0 ? "" : fmt::format("-{}", attempt);
        const std::string temporary =
            (fs::path(target).parent_path() /
             fitting_name("." + name.stem().string(),
                          fmt::format("{}{}{}", kTemporary, ::getpid(), count),
                          name.extension().string(), longest))
                .string();
        const Descriptor file(
            ::open(temporary.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666));
        if (file.get() >= 0) return temporary;
        if (errno != EEXIST) fail("write", path, errno);
    }
    fail("write", path, EEXIST);
}

void write_all(const std::string& path, const std::string& temporary, const std::string& text) {
    Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CLOEXEC));
    if (file.get() < 0) fail("write", path, errno);
    std::size_t done = 0;
    while (done < text.size()) {
        const ssize_t n = ::write(file.get(), text.data() + done, text.size() - done);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) fail("write", path, errno);
        done += static_cast<std::size_t>(n);
    }
    if (file.close() != 0) fail("write", path, errno);
}

}  // namespace

void require_writable(const std::string& path, bool overwrite) {
    const std::string target = follow_links(path);
    struct stat info = {};
    if (::stat(target.c_str(), &info) == 0) {
        if (S_ISDIR(info.st_mode)) fail("write", path, EISDIR);
        if (!S_ISREG(info.st_mode)) return;
        if (!overwrite)
            throw Failure(FailureKind::kOutput, fmt::format("'{}' exists; -y overwrites it", path));
    } else if (errno != ENOENT) {
        fail("write", path, errno);
    }

    const std::string folder = folder_of(target);
    if (::stat(folder.c_str(), &info) != 0) fail("write into the folder", folder, errno);
    if (!S_ISDIR(info.st_mode)) fail("write into the folder", folder, ENOTDIR);
    if (::access(folder.c_str(), W_OK | X_OK) != 0) fail("write into the folder", folder, errno);
}

void require_folder(const std::string& path) {
    std::error_code error;
    if (fs::exists(path, error) && !fs::is_directory(path, error))
        fail("make the folder", path, EEXIST);
}

void make_folder(const std::string& path) {
    std::error_code error;
    fs::create_directories(path, error);
    if (!error && !fs::is_directory(path)) error = std::make_error_code(std::errc::not_a_directory);
    if (error) fail("make the folder", path, error.value());
}

OutputFile::OutputFile(std::string path, Existing existing)
    : path_(std::move(path)), target_path_(follow_links(path_)), existing_(existing) {
    struct stat info = {};
    const bool exists = ::stat(target_path_.c_str(), &info) == 0;
    if (exists && S_ISDIR(info.st_mode)) fail("write", path_, EISDIR);
    // Renaming over a device would replace the device.
    in_place_ = exists && !S_ISREG(info.st_mode);
    temporary_path_ =
        in_place_ ? target_path_
                  : temporaries::add([this] { return create_temporary(path_, target_path_); });
}

OutputFile::~OutputFile() { discard(); }

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)),
      target_path_(std::move(other.target_path_)),
      temporary_path_(std::exchange(other.temporary_path_, {})),
      existing_(other.existing_),
      in_place_(other.in_place_) {}

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
    if (this == &other) return *this;
    discard();
    path_ = std::move(other.path_);
    target_path_ = std::move(other.target_path_);
    temporary_path_ = std::exchange(other.temporary_path_, {});
    existing_ = other.existing_;
    in_place_ = other.in_place_;
    return *this;
}

void OutputFile::commit(Durability durability) { publish(target_path_, durability); }

void OutputFile::commit_as(const std::string& path) {
    publish((fs::path(target_path_).parent_path() / fs::path(path).filename()).string(),
            Durability::kSynced);
}

std::string OutputFile::commit_partial() {
    constexpr int kMost = 10000;
    for (int number = 1;; ++number) {
        const std::string name = fs::path(partial_path(target_path_, number)).filename().string();
        const fs::path target = fs::path(target_path_).parent_path() / name;
        const int error = try_publish(target.string(), Durability::kSynced);
        if (error == 0) return (fs::path(path_).parent_path() / name).string();
        if (error != EEXIST || number == kMost) fail("write", target.string(), error);
    }
}

int OutputFile::try_publish(const std::string& target, Durability durability) {
    if (in_place_) return 0;
    {
        const Descriptor file(::open(temporary_path_.c_str(), O_RDONLY | O_CLOEXEC));
        if (file.get() < 0) return errno;
        if (existing_ == Existing::kReplace) take_over_mode(file, target);
        // EINVAL: a file system that knows no sync.
        if (durability == Durability::kSynced && ::fsync(file.get()) != 0 && errno != EINVAL)
            return errno;
    }
    int error = 0;
    if (existing_ == Existing::kKeep)
        error = rename_to_free_name(temporary_path_, target);
    else if (::rename(temporary_path_.c_str(), target.c_str()) != 0)
        error = errno;
    if (error == 0) {
        temporaries::forget(temporary_path_);
        temporary_path_.clear();
    }
    return error;
}

void OutputFile::publish(const std::string& target, Durability durability) {
    const int error = try_publish(target, durability);
    if (error == EEXIST)
        throw Failure(FailureKind::kOutput,
                      fmt::format("'{}' has appeared meanwhile; -y overwrites it", target));
    if (error != 0) fail("write", target, error);
}

void OutputFile::discard() noexcept {
    if (!temporary_path_.empty() && !in_place_) {
        ::unlink(temporary_path_.c_str());
        temporaries::forget(temporary_path_);
    }
    temporary_path_.clear();
}

std::string name_of_temporary(const std::string& name) {
    if (!name.starts_with('.')) return "";
    const std::string extension = fs::path(name).extension().string();
    const std::string stem = name.substr(1, name.size() - extension.size() - 1);
    const std::size_t mark = stem.rfind(kTemporary);
    if (mark == std::string::npos) return "";
    const std::string digits = stem.substr(mark + std::strlen(kTemporary));
    if (digits.empty() || digits.find_first_not_of("0123456789-") != std::string::npos) return "";
    return stem.substr(0, mark) + extension;
}

std::string partial_path(const std::string& path, int number) {
    const fs::path whole = path;
    const std::string middle = number == 1 ? ".partial" : fmt::format(".partial-{}", number);
    const std::string name =
        fitting_name(whole.stem().string(), middle, whole.extension().string(), longest_name(path));
    return (whole.parent_path() / name).string();
}

void write_text_file(const std::string& path, const std::string& text, Durability durability,
                     Existing existing) {
    OutputFile file(path, existing);
    write_all(path, file.temporary_path(), text);
    file.commit(durability);
}

}  // namespace carom
