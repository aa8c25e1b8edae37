// EXR's ZIP: how the bytes of a chunk are compressed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace carom {

/// Bytes at even places before those at odd ones, differences of neighbours, a zlib stream
/// ("OpenEXR File Layout"): as the library's own ZIP, by libdeflate in place of zlib, in a third of
/// its time. Holds buffers between calls; one object a thread.
class ExrZip {
  public:
    /// Loads libdeflate at the first call; Failure(kRun) that names its package if it is missing.
    ExrZip();
    ~ExrZip();
    ExrZip(const ExrZip&) = delete;
    ExrZip& operator=(const ExrZip&) = delete;

    /// Replaces `chunk`: by the bytes as they are where they do not become fewer.
    void compress(const std::uint8_t* bytes, std::size_t size, std::string& chunk);

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
    std::vector<std::uint8_t> reordered_;
};

}  // namespace carom
