// The end of a pipe.
#pragma once

namespace carom {

/// Thrown where the reader of a pipe that we write into has gone: no failure, there is just nobody
/// to work for. main ends with exit code 0.
struct ReaderGone {};

}  // namespace carom
