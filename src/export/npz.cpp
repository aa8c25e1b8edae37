#include "export/npz.h"

#include <fmt/format.h>
#include <minizip/zip.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <utility>

#include "core/check.h"
#include "core/failure.h"

namespace carom {

static_assert(std::endian::native == std::endian::little, "NumPy's types are named so");

namespace {

/// The type's size, as its name says: "<f8", "|b1"; a "U" is four bytes.
std::int64_t bytes_of(const std::string& type) {
    const std::int64_t count = std::stoll(type.substr(2));
    return type[1] == 'U' ? 4 * count : count;
}

/// numpy.lib.format, version 1.0: a dictionary, padded so that the data begins at 64 bytes.
std::string npy_head(const char* type, const std::vector<std::int64_t>& shape) {
    std::string extents;
    for (const std::int64_t n : shape) extents += fmt::format("{}, ", n);
    if (shape.size() > 1) extents.erase(extents.size() - 2);
    std::string text =
        fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, extents);
    constexpr std::size_t kBefore = 10, kAlign = 64;
    text.append(kAlign - (kBefore + text.size() + 1) % kAlign, ' ');
    text += '\n';
    std::string head("\x93NUMPY\x01\x00", 8);
    head += static_cast<char>(text.size() & 255U);
    head += static_cast<char>(text.size() >> 8U);
    return head + text;
}

}  // namespace

NpzWriter::NpzWriter(const std::string& path) : path_(path) {
    errno = 0;
    zip_ = zipOpen64(path.c_str(), APPEND_STATUS_CREATE);
    if (zip_ == nullptr) fail();
}

NpzWriter::~NpzWriter() {
    if (zip_ != nullptr) zipClose(zip_, nullptr);
}

void NpzWriter::fail() const {
    throw Failure(FailureKind::kOutput,
                  fmt::format("cannot write '{}': {}", path_,
                              errno != 0 ? std::strerror(errno) : "minizip gives no reason"));
}

void NpzWriter::end() {
    CAROM_CHECK(missing_, ==, 0);
    if (std::exchange(open_, false) && zipCloseFileInZip(zip_) != ZIP_OK) fail();
}

void NpzWriter::begin(const std::string& name, const char* type,
                      const std::vector<std::int64_t>& shape) {
    end();
    std::int64_t bytes = bytes_of(type);
    for (const std::int64_t n : shape) bytes *= n;
    const std::string head = npy_head(type, shape);
    constexpr std::int64_t kOf32Bits = 0xff000000;  // with room for the head
    zip_fileinfo info{};
    info.dosDate = 1U << 21U | 1U << 16U;  // 1 January 1980, the earliest that a zip knows
    errno = 0;
    if (zipOpenNewFileInZip64(zip_, (name + ".npy").c_str(), &info, nullptr, 0, nullptr, 0, nullptr,
                              0, 0, bytes > kOf32Bits ? 1 : 0) != ZIP_OK)
        fail();
    open_ = true;
    missing_ = bytes + static_cast<std::int64_t>(head.size());
    write(head.data(), head.size());
}

void NpzWriter::write(const void* bytes, std::size_t count) {
    constexpr std::size_t kMost = 1U << 30U;  // minizip counts in 32 bits
    const char* from = static_cast<const char*>(bytes);
    missing_ -= static_cast<std::int64_t>(count);
    CAROM_CHECK(missing_, >=, 0);
    while (count > 0) {
        const std::size_t part = std::min(count, kMost);
        errno = 0;
        if (zipWriteInFileInZip(zip_, from, static_cast<unsigned>(part)) != ZIP_OK) fail();
        from += part;
        count -= part;
    }
}

void NpzWriter::put(const std::string& name, const std::vector<double>& values,
                    std::vector<std::int64_t> shape) {
    if (shape.empty()) shape = {static_cast<std::int64_t>(values.size())};
    begin(name, "<f8", shape);
    write(values.data(), values.size() * sizeof(double));
}

void NpzWriter::put(const std::string& name, const std::vector<std::int32_t>& values) {
    begin(name, "<i4", {static_cast<std::int64_t>(values.size())});
    write(values.data(), values.size() * sizeof(std::int32_t));
}

void NpzWriter::put_flags(const std::string& name, const std::vector<std::uint8_t>& values) {
    begin(name, "|b1", {static_cast<std::int64_t>(values.size())});
    write(values.data(), values.size());
}

void NpzWriter::put(const std::string& name, const std::vector<std::string>& values) {
    std::size_t longest = 1;
    for (const std::string& value : values) longest = std::max(longest, value.size());
    std::vector<char32_t> text(values.size() * longest);
    for (std::size_t i = 0; i < values.size(); ++i)
        for (std::size_t k = 0; k < values[i].size(); ++k)
            text[i * longest + k] = static_cast<unsigned char>(values[i][k]);
    begin(name, fmt::format("<U{}", longest).c_str(), {static_cast<std::int64_t>(values.size())});
    write(text.data(), text.size() * sizeof(char32_t));
}

void NpzWriter::finish() {
    end();
    errno = 0;
    if (zipClose(std::exchange(zip_, nullptr), nullptr) != ZIP_OK) fail();
}

}  // namespace carom
