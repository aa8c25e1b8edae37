#include "media/exr_zip.h"

#include <libdeflate.h>

#include <new>

#include "core/shared_library.h"

namespace carom {

namespace {

/// Higher ones take twice the time for a tenth less.
constexpr int kLevel = 1;

struct Deflate {
    decltype(&::libdeflate_alloc_compressor) make = nullptr;
    decltype(&::libdeflate_free_compressor) free = nullptr;
    decltype(&::libdeflate_zlib_compress) compress = nullptr;
};

const Deflate& deflate() {
    static const Deflate table = [] {
        // As its interface is numbered since its beginning.
        const SharedLibrary library("libdeflate.so.0",
                                    "EXR files need libdeflate (package libdeflate0)");
        Deflate found;
        library.find(found.make, "libdeflate_alloc_compressor");
        library.find(found.free, "libdeflate_free_compressor");
        library.find(found.compress, "libdeflate_zlib_compress");
        return found;
    }();
    return table;
}

}  // namespace

class ExrZip::Impl {
  public:
    Impl() : compressor_(deflate().make(kLevel)) {
        if (compressor_ == nullptr) throw std::bad_alloc();
    }
    ~Impl() { deflate().free(compressor_); }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    libdeflate_compressor* compressor() { return compressor_; }

  private:
    libdeflate_compressor* compressor_;
};

ExrZip::ExrZip() : impl_(std::make_unique<Impl>()) {}
ExrZip::~ExrZip() = default;

void ExrZip::compress(const std::uint8_t* bytes, std::size_t size, std::string& chunk) {
    reordered_.resize(size);
    const std::size_t half = (size + 1) / 2;
    for (std::size_t i = 0; i < half; ++i) reordered_[i] = bytes[2 * i];
    for (std::size_t i = half; i < size; ++i) reordered_[i] = bytes[2 * (i - half) + 1];
    for (std::size_t i = size; i-- > 1;)
        reordered_[i] = static_cast<std::uint8_t>(reordered_[i] - reordered_[i - 1] + 128);
    chunk.resize(size);
    // Nothing where there is no room: it would be no shorter.
    const std::size_t made =
        deflate().compress(impl_->compressor(), reordered_.data(), size, chunk.data(), size - 1);
    if (made == 0)
        chunk.assign(reinterpret_cast<const char*>(bytes), size);
    else
        chunk.resize(made);
}

}  // namespace carom
