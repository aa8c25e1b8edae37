// States and events of a motion as arrays of NumPy. docs/exports.md lists them.
#pragma once

#include <functional>
#include <string>

#include "motion/motion.h"
#include "motion/row_times.h"
#include "scene/scene.h"

namespace carom {

/// Writes `path` (.npz): the states at `times`, the rows of MOTION.csv, and the events. Numbers are
/// those of the CSV files bit for bit. `told` is called now and then with the part that is written,
/// 0 ... 1; it may throw. Failure(kOutput).
void write_motion_npz(const Scene& scene, const Motion& motion, const RowTimes& times,
                      const std::string& path, const std::function<void(double)>& told = {});

}  // namespace carom
