// What the process inherits and cannot work with, put right before anything else.
#pragma once

namespace carom {

/// Opens descriptors 0, 1 and 2 on /dev/null where the caller closed them: the first file that is
/// opened would else take their place, and messages would be written into it. What is asked to be
/// read from such a standard input, or written to such a standard output, still fails; to be called
/// first in main.
void open_standard_descriptors();

/// Writing to a pipe that nobody reads, or a file beyond `ulimit -f`, fails as any other writing
/// does, instead of ending the process.
void let_writing_fail();

/// Where the address space is limited (`ulimit -v`): one heap for all threads, instead of 64 MB set
/// aside for each.
void share_the_heap_where_it_is_limited();

/// SVT-AV1 prints what it is about to do on standard error, unless this variable says "errors
/// only". Before any thread starts.
void quiet_libraries();

}  // namespace carom
