#include "media/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "core/failure.h"
#include "core/temporaries.h"

namespace carom {

namespace {

namespace fs = std::filesystem;

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

/// Reserves a name beside `target` that no other process or thread has.
std::string create_temporary(const std::string& path, const std::string& target) {
    constexpr int kMostAttempts = 10000;
    constexpr std::size_t kLongestStem = 150;  // names end at 255 bytes; this leaves the rest room
    const fs::path name = fs::path(target).filename();
    const std::string stem = name.stem().string().substr(0, kLongestStem);
    for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
        const std::string count = attempt == 0 ? "" : fmt::format("-{}", attempt);
        const std::string temporary =
            (fs::path(target).parent_path() /
             fmt::format(".{}.tmp{}{}{}", stem, ::getpid(), count, name.extension().string()))
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

OutputFile::OutputFile(std::string path)
    : path_(std::move(path)), target_path_(follow_links(path_)) {
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
      in_place_(other.in_place_) {}

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
    if (this == &other) return *this;
    discard();
    path_ = std::move(other.path_);
    target_path_ = std::move(other.target_path_);
    temporary_path_ = std::exchange(other.temporary_path_, {});
    in_place_ = other.in_place_;
    return *this;
}

void OutputFile::commit(Durability durability) { publish(target_path_, durability); }

void OutputFile::commit_as(const std::string& path) {
    publish((fs::path(target_path_).parent_path() / fs::path(path).filename()).string(),
            Durability::kSynced);
}

void OutputFile::publish(const std::string& target, Durability durability) {
    if (!in_place_) {
        if (durability == Durability::kSynced) {
            const Descriptor file(::open(temporary_path_.c_str(), O_RDONLY | O_CLOEXEC));
            // EINVAL: a file system that knows no sync.
            if (file.get() < 0 || (::fsync(file.get()) != 0 && errno != EINVAL))
                fail("write", path_, errno);
        }
        if (::rename(temporary_path_.c_str(), target.c_str()) != 0) fail("write", target, errno);
        temporaries::forget(temporary_path_);
    }
    temporary_path_.clear();
}

void OutputFile::discard() noexcept {
    if (!temporary_path_.empty() && !in_place_) {
        ::unlink(temporary_path_.c_str());
        temporaries::forget(temporary_path_);
    }
    temporary_path_.clear();
}

std::string partial_path(const std::string& path) {
    const fs::path whole = path;
    const std::string name = whole.stem().string() + ".partial" + whole.extension().string();
    return (whole.parent_path() / name).string();
}

void write_text_file(const std::string& path, const std::string& text, Durability durability) {
    OutputFile file(path);
    write_all(path, file.temporary_path(), text);
    file.commit(durability);
}

}  // namespace carom
