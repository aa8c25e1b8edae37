// What the library throws.
#pragma once

#include <carom/export.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

CAROM_NAMESPACE_BEGIN

/// One mistake or warning in a scene.
struct Diagnostic {
    bool error = true;         ///< else a warning
    std::string file;          ///< as it was named; "<text>" for a text, "set PATH" for a setting
    int line = 0, column = 0;  ///< from 1; 0 where unknown
    std::string message;       ///< what is wrong, and what would be right
    std::string shown;  ///< file:line:column: error: message, and below it the line with a mark
};

/// Anything that went wrong: a file that cannot be read or written, a codec or a driver that is
/// missing, a wrong argument. The text says what was attempted, on which path, and why it
/// failed.
class CAROM_API Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
    ~Error() override;
};

/// A scene with mistakes; the text has all of them.
class CAROM_API SceneError : public Error {
  public:
    SceneError(const std::string& text, std::vector<Diagnostic> all)
        : Error(text), diagnostics_(std::move(all)) {}
    ~SceneError() override;
    /// In the order of the file, warnings among them.
    const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

  private:
    std::vector<Diagnostic> diagnostics_;
};

/// Work that was stopped by its std::stop_token.
class CAROM_API Stopped : public Error {
  public:
    using Error::Error;
    ~Stopped() override;
};

CAROM_NAMESPACE_END
