// What went wrong outside the user's scene and outside our own code: a file, a codec, a driver.
#pragma once

#include <stdexcept>
#include <string>

namespace carom {

/// Decides the exit code, see the table in docs/commands.md.
enum class FailureKind {
    kRun,     ///< failed while running: a missing codec, a driver, a solver (exit 1)
    kInput,   ///< an input file that is missing or unreadable, or wrong usage (exit 2)
    kOutput,  ///< output that could not be written, or that exists already (exit 4)
};

/// The one exception that stages throw; caught once, in main. The message says what was attempted,
/// on which path, and the library's own text.
class Failure : public std::runtime_error {
  public:
    Failure(FailureKind kind, const std::string& message)
        : std::runtime_error(message), kind_(kind) {}

    FailureKind kind() const { return kind_; }

  private:
    FailureKind kind_;
};

}  // namespace carom
