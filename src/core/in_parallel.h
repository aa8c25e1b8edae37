// One piece of work many times, on all processors.
#pragma once

#include <functional>

namespace carom {

/// Calls work(0) ... work(count - 1), each once, in any order, on the calling thread and others
/// beside it; returns when all are done, how many CPU seconds the others took. The first exception
/// ends the rest and is thrown on. Where the system gives no thread the calling one does all.
double in_parallel(int count, const std::function<void(int)>& work);

}  // namespace carom
