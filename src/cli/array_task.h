// Which task of a batch system's array this process is.
#pragma once

#include <cstdint>
#include <string>

namespace carom {

/// Task `place` of `count`, counted from 1.
struct ArrayTask {
    std::int64_t place = 1;
    std::int64_t count = 1;
};

/// From the variables of Slurm (sbatch --array), Grid Engine (qsub -t) or AWS Batch, whichever are
/// set; steps such as --array=1-9:2 count as they stand. Failure(kInput), beginning with `option`,
/// where none are, where an array has gaps, which tell no place, and where a batch system tells its
/// tasks a number but not of how many.
ArrayTask array_task(const std::string& option);

}  // namespace carom
