#include "media/text_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/failure.h"

namespace carom {

TextFile::TextFile(const std::string& path, Existing existing)
    : file_(path, existing),
      descriptor_(::open(file_.temporary_path().c_str(), O_WRONLY | O_CLOEXEC)) {
    if (descriptor_ < 0) fail();
}

TextFile::~TextFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void TextFile::fail() const {
    throw Failure(FailureKind::kOutput,
                  fmt::format("cannot write '{}': {}", file_.path(), std::strerror(errno)));
}

void TextFile::write(std::string_view text) {
    while (!text.empty()) {
        const ssize_t n = ::write(descriptor_, text.data(), text.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) fail();
        text.remove_prefix(static_cast<std::size_t>(n));
    }
}

void TextFile::commit() {
    if (::close(std::exchange(descriptor_, -1)) != 0) fail();
    file_.commit();
}

}  // namespace carom
