// What a process can leave undone because it ends soon.
#pragma once

namespace carom {

/// Asks the system for the heap in large parts, and hands nothing back. (Not in large pages: where a
/// host takes back what its guests do not use, they cost more than they save.)
void ask_for_memory_in_large_parts();

/// Ends the process once all is written: the system frees what a driver would take apart piece by
/// piece, a thirtieth of a still's time.
[[noreturn]] void end_at_once(int exit_code);

}  // namespace carom
