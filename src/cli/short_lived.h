// What a process can leave undone because it ends soon.
#pragma once

#include <cstddef>

namespace carom {

/// True for so few pixels that programs which compile soon pay (PainterOptions::few_pictures).
bool draws_sooner_than_it_compiles(int width_px, int height_px, std::size_t pictures = 1);

/// Asks the system for the heap in large parts, and hands nothing back. (Not in large pages: where
/// a host takes back what its guests do not use, they cost more than they save.)
void ask_for_memory_in_large_parts();

/// Ends the process once all is written: the system frees what a driver would take apart piece by
/// piece, a thirtieth of a still's time.
[[noreturn]] void end_at_once(int exit_code);

}  // namespace carom
