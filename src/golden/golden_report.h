// All that one `carom golden check` found, and the files that tell of it.
#pragma once

#include <string>
#include <vector>

#include "core/image_measures.h"
#include "golden/still_check.h"

namespace carom {

struct GoldenReport {
    std::string version;  ///< of carom
    std::string folder;   ///< of the goldens
    ImageTolerance limits;
    std::vector<StillCheck> stills;           ///< in the order in which they were drawn
    std::vector<std::string> orphans;         ///< paths of goldens that no still belongs to
    std::vector<std::string> invalid_scenes;  ///< paths

    int count(Outcome outcome) const;
    /// "3 same, 1 different, 0 missing, 0 unreadable".
    std::string counts_text() const;
};

/// One page with everything in it: expected, actual and difference of each still that is not the
/// same, side by side, blinking and under a slider. It loads nothing, and works without a script
/// but for the slider.
///
/// A golden is in it once, as the file that it is; of what was drawn the part that differs is. So
/// the page is as large as goldens and these parts in base64, and about 8 KB + 1 KB a still.
std::string html_page(const GoldenReport& report);

/// JUnit's XML as CI services read it: a suite a scene, a case a still; `failure` for different and
/// missing ones, `error` for unreadable ones and invalid scenes.
std::string junit_xml(const GoldenReport& report);

/// JSON for programs, and for `carom golden accept`. `path` is where it will stand: paths of drawn
/// pictures in it are relative to that folder, all others as the command line had them.
std::string report_json(const GoldenReport& report, const std::string& path);

}  // namespace carom
