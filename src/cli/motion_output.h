// The formats that `carom simulate` writes a motion in.
#pragma once

#include <functional>
#include <string>

#include "cli/interrupt.h"
#include "media/output_file.h"
#include "motion/csv.h"
#include "scene/scene.h"

namespace carom {

enum class MotionFormat { kCsv, kJson, kNpz, kGlb };

/// By the extension of `path`; CSV for every other one. Of "-" what `format` says, "" being CSV.
/// Failure(kInput) for a format with a file, whose name says it.
MotionFormat motion_format(const std::string& path, const std::string& format);

/// True where the motion is written as states at instants: those take a rate.
bool has_rows(MotionFormat format);

/// Runs `write` into a file that appears when whole, or into standard output for "-".
void write_text_output(const std::string& path, Existing existing, const Interrupt& interrupt,
                       const std::function<void(const TextSink&)>& write);

/// Writes a format other than CSV; `told` is called with the part of the work that is done.
void write_motion(MotionFormat format, const Scene& scene, const Motion& motion,
                  const std::string& path, Existing existing, const Interrupt& interrupt,
                  const FrameRate& rate, const std::function<void(double)>& told);

}  // namespace carom
