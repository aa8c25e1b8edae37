// Checks on our own code, in all builds: a failed one is a bug of carom, and says both sides.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace carom {

/// A bug in carom, never a user's mistake.
class Bug : public std::logic_error {
  public:
    using std::logic_error::logic_error;
};

namespace detail {

template <class A, class B>
[[noreturn]] void check_failed(const char* file, int line, const char* expression, const A& a,
                               const B& b) {
    std::ostringstream text;
    text << "internal error at " << file << ":" << line << ": " << expression << " does not hold ("
         << a << " against " << b << ")";
    throw Bug(text.str());
}

}  // namespace detail

}  // namespace carom

/// CAROM_CHECK(i, <, n): throws Bug with both values when the comparison does not hold.
#define CAROM_CHECK(a, op, b)                                                                   \
    do {                                                                                        \
        const auto& carom_check_a = (a);                                                        \
        const auto& carom_check_b = (b);                                                        \
        if (!(carom_check_a op carom_check_b))                                                  \
            ::carom::detail::check_failed(__FILE__, __LINE__, #a " " #op " " #b, carom_check_a, \
                                          carom_check_b);                                       \
    } while (false)
