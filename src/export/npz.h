// NumPy's files of arrays: a zip of .npy files, stored as they are.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// Writes `path`, array after array; NumPy's format 1.0 (numpy.lib.format) in a zip whose entries
/// are dated 1980, so that equal arrays give equal bytes. Throws Failure(kOutput).
class NpzWriter {
  public:
    explicit NpzWriter(const std::string& path);
    ~NpzWriter();
    NpzWriter(const NpzWriter&) = delete;
    NpzWriter& operator=(const NpzWriter&) = delete;

    /// Begins an array of this type ("<f8", "<i4", "|b1", "<U6") and shape, rows first; exactly as
    /// many bytes as it has must be written before the next one.
    void begin(const std::string& name, const char* type, const std::vector<std::int64_t>& shape);
    void write(const void* bytes, std::size_t count);

    void put(const std::string& name, const std::vector<double>& values,
             std::vector<std::int64_t> shape = {});
    void put(const std::string& name, const std::vector<std::int32_t>& values);
    void put_flags(const std::string& name, const std::vector<std::uint8_t>& values);
    /// ASCII texts.
    void put(const std::string& name, const std::vector<std::string>& values);

    void finish();

  private:
    [[noreturn]] void fail() const;
    void end();

    std::string path_;
    void* zip_;
    bool open_ = false;
    std::int64_t missing_ = 0;  ///< bytes of the array at hand
};

}  // namespace carom
