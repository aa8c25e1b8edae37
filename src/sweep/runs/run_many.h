// Many runs at once: in threads of this process, or in processes of their own.
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "sweep/runs/run_record.h"

namespace carom {

class RunMaker;

/// How one run ended.
struct RunOutcome {
    std::int64_t run = 0;
    bool done = true;
    std::string reason;  ///< where it is not
};

struct ManyRuns {
    const std::vector<std::int64_t>& todo;  ///< in order of their numbers
    int jobs = 1;                           ///< at most so many at once
    bool fail_fast = false;                 ///< none is begun after one that failed
    std::stop_token stop;                   ///< none is begun, and what was is left
    /// Makes what makes runs: called once by each thread or process.
    std::function<RunMaker()> make_maker;
    /// Called on the calling thread as runs end, in any order, and now and then without one.
    std::function<void(const RunOutcome*)> tell;
};

/// For runs without pictures, which share the base's document. The first failure that is not a
/// run's own (a full disk) ends all and is thrown on.
void run_in_threads(const ManyRuns& runs);

/// For runs with pictures: each process has a context to draw with, and one that ends takes its run
/// with it, which has failed then, while the others go on. Call it from a process whose other
/// threads hold nothing: they are not there in the copies that fork() makes. Fails likewise.
void run_in_processes(const ManyRuns& runs);

}  // namespace carom
