// A file that is written piece by piece.
#pragma once

#include <string>
#include <string_view>

#include "media/output_file.h"

namespace carom {

/// Text into a file that appears when it is whole. The first piece that cannot be written fails
/// with Failure(kOutput), the path and the system's text.
class TextFile {
  public:
    explicit TextFile(const std::string& path, Existing existing = Existing::kReplace);
    ~TextFile();
    TextFile(const TextFile&) = delete;
    TextFile& operator=(const TextFile&) = delete;

    void write(std::string_view text);
    void commit();  ///< must be called; a file that is not committed is removed

  private:
    [[noreturn]] void fail() const;

    OutputFile file_;
    int descriptor_;
};

}  // namespace carom
