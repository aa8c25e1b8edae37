#include "cli/short_lived.h"

#include <malloc.h>

#include <cstdio>
#include <cstdlib>

namespace carom {

bool draws_sooner_than_it_compiles(int width_px, int height_px, std::size_t pictures) {
    constexpr double kFewPixels = 4e6;  // found on two cores without a GPU: docs/drawing.md
    return static_cast<double>(pictures) * width_px * height_px <= kFewPixels;
}

void ask_for_memory_in_large_parts() {
    constexpr int kPart = 64 << 20, kNeverTrim = 1 << 30;
    constexpr int kLargestInHeap = 32 << 20;  // the largest that malloc accepts
    mallopt(M_TOP_PAD, kPart);
    mallopt(M_TRIM_THRESHOLD, kNeverTrim);
    mallopt(M_MMAP_THRESHOLD, kLargestInHeap);
}

void end_at_once(int exit_code) {
    std::fflush(nullptr);
    std::quick_exit(exit_code);
}

}  // namespace carom
