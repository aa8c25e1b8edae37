// A folder of its own for work on the way, which goes with its content.
#pragma once

#include <filesystem>
#include <string>

#include "core/failure.h"

namespace carom {

class TemporaryFolder {
  public:
    /// Below the system's folder for such, and named so that none other has the name; a failure of
    /// that kind if it cannot be made.
    explicit TemporaryFolder(FailureKind kind);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    /// The path of a file in it.
    std::string file(const std::string& name) const { return (path_ / name).string(); }

  private:
    std::filesystem::path path_;
};

}  // namespace carom
