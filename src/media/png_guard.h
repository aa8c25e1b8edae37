// How calls of libpng end when it fails.
#pragma once

// libpng wants setjmp's header first.
#include <csetjmp>
//
#include <png.h>

#include <array>
#include <cstdio>

namespace carom {

/// libpng's last words; plain data, because longjmp runs no destructors.
struct PngText {
    std::array<char, 256> text = {};
};

extern "C" {
inline void carom_png_error(png_structp png, png_const_charp message) {
    auto* text = static_cast<PngText*>(png_get_error_ptr(png));
    std::snprintf(text->text.data(), text->text.size(), "%s", message);
    png_longjmp(png, 1);
}

inline void carom_png_warning(png_structp, png_const_charp) {}  // what can be read is read
}

/// Runs `calls`, which may be left by longjmp at any call of libpng: it must own nothing.
/// False: libpng failed, the text says why.
template <class Calls>
bool guarded(png_structp png, const Calls& calls) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    calls();
    return true;
}

}  // namespace carom
