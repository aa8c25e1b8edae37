#include "render/draw2d/embedded_font.h"

// The assembler copies the file: a list of numbers of this length takes the compiler a second.
asm(".pushsection .rodata\n"
    ".balign 8\n"
    "carom_font:\n"
    ".incbin \"" CAROM_FONT_FILE
    "\"\n"
    "carom_font_end:\n"
    ".popsection\n");

extern "C" {
__attribute__((visibility("hidden"))) extern const unsigned char carom_font[];
__attribute__((visibility("hidden"))) extern const unsigned char carom_font_end[];
}

namespace carom {

std::span<const unsigned char> embedded_font() { return {carom_font, carom_font_end}; }

}  // namespace carom
