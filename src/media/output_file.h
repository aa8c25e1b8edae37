// Output that appears under its name only when it is whole.
#pragma once

#include <string>

namespace carom {

/// Throws Failure(kOutput) if `path` exists and `overwrite` is false, if its folder does not exist
/// or cannot be written, or if it is a folder. Call it before the work, not after.
void require_writable(const std::string& path, bool overwrite);

/// A temporary name beside `path`; commit() renames it to `path`, the destructor removes it.
class OutputFile {
  public:
    explicit OutputFile(std::string path);
    ~OutputFile();
    OutputFile(OutputFile&& other) noexcept;
    OutputFile& operator=(OutputFile&& other) noexcept;

    const std::string& path() const { return path_; }
    const std::string& temporary_path() const { return temporary_path_; }
    void commit();                            ///< rename to path(), fails with Failure(kOutput)
    void commit_as(const std::string& path);  ///< the same under another name

  private:
    std::string path_;
    std::string temporary_path_;
};

/// OUT.partial.EXT for OUT.EXT.
std::string partial_path(const std::string& path);

/// Writes all of `text` to `path` through an OutputFile.
void write_text_file(const std::string& path, const std::string& text);

}  // namespace carom
