// carom render --resume: of PNG frames only those that are not there yet.
#pragma once

#include <vector>

#include "cli/interrupt.h"
#include "cli/outputs.h"

namespace carom {

/// Refuses outputs other than frames in files: Failure(kInput), which says what serves instead.
void require_resumable(const std::vector<OutputRequest>& outputs);

/// Those of the source's frames that one of the outputs lacks: no file, one that is damaged or no
/// PNG, or one that says another scene, size, instant, physical size, second run or version of
/// carom. Throws Interrupted.
FrameRanges missing_frames(const std::vector<OutputRequest>& outputs, const FilmSource& source,
                           const EncodingOptions& encoding, const Interrupt& interrupt);

/// Removes the temporary files that a killed run has left of these frames. Nobody else may be at
/// work on the same frames; other chunks in the same folder may.
void remove_leftovers(const std::vector<OutputRequest>& outputs, const FrameRanges& frames);

}  // namespace carom
