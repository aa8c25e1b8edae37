// libpng as C++ calls it: its errors, and its writer into memory.
#pragma once

// libpng wants setjmp's header first.
#include <csetjmp>
//
#include <png.h>

#include <array>
#include <new>
#include <string>

namespace carom {

/// libpng's last words; plain data, because longjmp runs no destructors.
struct PngText {
    std::array<char, 256> text = {};
};

extern "C" {
void carom_png_error(png_structp png, png_const_charp message);
void carom_png_warning(png_structp, png_const_charp);
/// Onto the std::string of the writer.
void carom_png_append(png_structp png, png_bytep data, png_size_t size);
}

/// Runs `calls`, which may be left by longjmp at any call of libpng: it must own nothing.
/// False: libpng failed, the text says why.
template <class Calls>
bool guarded(png_structp png, const Calls& calls) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    calls();
    return true;
}

/// libpng's writer, and the bytes that it has made.
class PngWriter {
  public:
    PngWriter() {
        png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, &text_, carom_png_error,
                                       carom_png_warning);
        if (png_ != nullptr) info_ = png_create_info_struct(png_);
        if (info_ == nullptr) {
            png_destroy_write_struct(&png_, nullptr);
            throw std::bad_alloc();
        }
    }
    ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;

    png_structp png() { return png_; }
    png_infop info() { return info_; }
    const char* text() const { return text_.text.data(); }
    std::string& bytes() { return bytes_; }

  private:
    PngText text_;
    std::string bytes_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

}  // namespace carom
