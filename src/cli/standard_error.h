// What is said to a person, on standard error.
#pragma once

#include <fmt/format.h>

#include <string_view>

namespace carom {

/// Writes all of `text`, or as much as can be written: a terminal that is gone, a full disk, a
/// reader that has left change nothing in the work, and nothing in the exit code.
void write_standard_error(std::string_view text) noexcept;

/// The same where the process must not wait for a reader that is slow.
void write_standard_error_at_once(std::string_view text) noexcept;

/// fmt::format to standard error.
template <class... Arguments>
void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    write_standard_error(fmt::format(format, std::forward<Arguments>(arguments)...));
}

}  // namespace carom
