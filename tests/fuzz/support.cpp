#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "target.h"

namespace carom::fuzz {

namespace {

namespace fs = std::filesystem;

/// In memory where the system has such a folder; removed at the end of the process.
struct Folder {
    fs::path path;
    Folder() {
        const fs::path memory = "/dev/shm";
        std::error_code error;
        const fs::path above = fs::is_directory(memory, error) && ::access("/dev/shm", W_OK) == 0
                                   ? memory
                                   : fs::temp_directory_path();
        std::string name = (above / "carom-fuzz-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) broken_promise("no folder for files");
        path = name;
    }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
};

void write(const fs::path& path, std::string_view content) {
    const int file = ::open(path.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0600);
    const bool whole = file >= 0 && ::write(file, content.data(), content.size()) ==
                                        static_cast<ssize_t>(content.size());
    if (file >= 0) ::close(file);
    if (!whole) broken_promise("cannot write " + path.string());
}

}  // namespace

void broken_promise(const std::string& what) {
    std::fprintf(stderr, "broken promise: %s\n", what.c_str());
    std::abort();
}

std::string file_beside(const std::string& name, std::string_view content) {
    static const Folder folder;
    const fs::path path = folder.path / name;
    write(path, content);
    return path.string();
}

std::string file_with(std::string_view content, const std::string& extension) {
    return file_beside("input" + extension, content);
}

}  // namespace carom::fuzz
