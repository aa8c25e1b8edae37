// How far two PNG files are apart, without their pictures in memory.
#pragma once

#include <string>

#include "core/image_measures.h"

namespace carom {

/// measure_difference() of what read_any_png() gives. Both are read at once, where there may be
/// another thread, a band of rows after the other; one content under two names is read once.
/// Fails as read_any_png() does, also for damage behind the rows that tell.
ImageMeasures measure_pngs(const std::string& a, const std::string& b);

}  // namespace carom
