#include "media/libav.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <mutex>

namespace carom {

namespace {

// FFmpeg's log callback takes no pointer of ours, so the innermost scope of each thread is found
// here.
thread_local LibavMessages* innermost = nullptr;

}  // namespace

LibavMessages::LibavMessages() : outer_(innermost) {
    static std::once_flag installed;
    std::call_once(installed, [] { libav().av_log_set_callback(&LibavMessages::receive); });
    innermost = this;
}

LibavMessages::~LibavMessages() { innermost = outer_; }

void LibavMessages::receive(void*, int level, const char* format, va_list arguments) {
    constexpr std::size_t kMostLines = 4;  // the first ones name the cause
    if (level > AV_LOG_ERROR || innermost == nullptr) return;
    if (innermost->lines_.size() >= kMostLines) return;
    std::array<char, 512> buffer = {};
    std::vsnprintf(buffer.data(), buffer.size(), format, arguments);
    try {
        std::string line = buffer.data();
        while (!line.empty() && (line.back() == '\n' || line.back() == ' ')) line.pop_back();
        if (!line.empty()) innermost->lines_.push_back(std::move(line));
    } catch (...) {
        return;  // no memory for the message: the error code still tells
    }
}

std::string LibavMessages::text() const {
    std::string all;
    for (const std::string& line : lines_) all += "; " + line;
    return all;
}

void throw_libav(FailureKind kind, const std::string& action, const std::string& path, int code,
                 const LibavMessages& messages) {
    std::array<char, AV_ERROR_MAX_STRING_SIZE> text = {};
    libav().av_strerror(code, text.data(), text.size());
    throw Failure(kind,
                  fmt::format("cannot {} '{}': {}{}", action, path, text.data(), messages.text()));
}

std::string libav_url(const std::string& path) { return "file:" + path; }

}  // namespace carom
