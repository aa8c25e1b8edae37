#include "cli/terminal.h"

#include <sys/ioctl.h>

#include <charconv>
#include <cstdlib>
#include <string_view>

namespace carom {

int terminal_columns(int descriptor) {
    constexpr int kUnknown = 80;
    winsize size{};
    if (::ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
    const char* text = std::getenv("COLUMNS");
    if (text == nullptr) return kUnknown;
    const std::string_view digits = text;
    int columns = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), columns);
    return columns > 0 ? columns : kUnknown;
}

bool is_dumb_terminal() {
    const char* name = std::getenv("TERM");
    return name == nullptr || *name == '\0' || std::string_view(name) == "dumb";
}

}  // namespace carom
