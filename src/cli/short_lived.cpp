#include "cli/short_lived.h"

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace carom {

void prefer_large_pages() {
    constexpr int kPart = 256 << 20, kNeverTrim = 1 << 30;
    constexpr int kLargestInHeap = 32 << 20;  // the largest that malloc accepts
    mallopt(M_TOP_PAD, kPart);
    mallopt(M_TRIM_THRESHOLD, kNeverTrim);
    mallopt(M_MMAP_THRESHOLD, kLargestInHeap);
    auto* begin = static_cast<char*>(sbrk(0));
    void* volatile first = std::malloc(kLargestInHeap / 2);  // the heap grows by that and a part
    std::free(first);
    auto* end = static_cast<char*>(sbrk(0));
    const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
    const std::uintptr_t past_page = reinterpret_cast<std::uintptr_t>(begin) % page;
    if (past_page != 0) begin += page - past_page;
    if (begin < end) madvise(begin, static_cast<std::size_t>(end - begin), MADV_HUGEPAGE);
}

void end_at_once(int exit_code) {
    std::fflush(nullptr);
    std::quick_exit(exit_code);
}

}  // namespace carom
