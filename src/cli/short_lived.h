// What a process can leave undone because it ends soon.
#pragma once

namespace carom {

/// Asks for the heap in large parts, of large pages where the system gives them on request, and
/// hands nothing back: a page fault each 4 KiB would cost a still about a tenth of its time. To be
/// called early, in the main thread. Only the speed depends on it.
void prefer_large_pages();

/// Ends the process once all is written: the system frees what a driver would take apart piece by
/// piece, a thirtieth of a still's time.
[[noreturn]] void end_at_once(int exit_code);

}  // namespace carom
