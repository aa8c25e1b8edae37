// MOTION.csv and EVENTS.csv as the contract of the formats in docs/output.md says.
#pragma once

#include <functional>
#include <string_view>

#include "motion/motion.h"

namespace carom {

/// Receives the text in pieces of some kilobytes, in order.
using TextSink = std::function<void(std::string_view)>;

/// Rows at k / rate for k = 0 ... floor(duration * rate + 1e-9), and the duration itself last.
/// `rate` is a fraction so that 30000/1001 stays exact.
/// `progress`, if there is any, is told now and then up to which time rows are written, in s.
/// `await`, if there is any, is called before the rows of each time: of a motion that is still
/// being made it returns when the balls are known then.
void write_motion_csv(const Motion& motion, int rate_numerator, int rate_denominator,
                      const TextSink& sink, const std::function<void(double)>& progress = {},
                      const std::function<void(double)>& await = {});

void write_events_csv(const Motion& motion, const TextSink& sink);

}  // namespace carom
