#include "media/png_writer.h"

#include <cstdio>

namespace carom {

extern "C" {
void carom_png_error(png_structp png, png_const_charp message) {
    auto* text = static_cast<PngText*>(png_get_error_ptr(png));
    std::snprintf(text->text.data(), text->text.size(), "%s", message);
    png_longjmp(png, 1);
}

void carom_png_warning(png_structp, png_const_charp) {}  // what can be read is read

void carom_png_append(png_structp png, png_bytep data, png_size_t size) {
    bool full = false;
    try {
        static_cast<std::string*>(png_get_io_ptr(png))
            ->append(reinterpret_cast<const char*>(data), size);
    } catch (...) {
        full = true;  // an exception must not pass through C
    }
    if (full) png_error(png, "out of memory");
}
}

}  // namespace carom
