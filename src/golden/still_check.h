// One still against its golden.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/image_measures.h"
#include "core/pixel_rect.h"

namespace carom {

enum class Outcome { kSame, kDifferent, kMissing, kUnreadable };

/// Limits of golden pictures. A golden that was drawn by the still's own renderer (it says by
/// which) can be held to more: only processors of other makers are left between the two.
struct GoldenLimits {
    ImageTolerance any;
    std::optional<int> same_renderer{};  ///< largest difference of any channel, 0 ... 255
};

/// "same", "different", "missing", "unreadable".
const char* outcome_word(Outcome outcome);

/// A still that was drawn, and where its golden would be.
struct DrawnStill {
    std::string name;   ///< figure8-t1.000000
    std::string scene;  ///< as the command line names it
    double time_s = 0;
    std::string folder;    ///< of the goldens
    std::string golden;    ///< path of the golden
    std::string renderer;  ///< what drew it
};

/// What was found, with as much of the pictures as reports show. Pictures are PNG files' bytes, and
/// empty where all is the same.
struct StillCheck {
    DrawnStill still;
    Outcome outcome = Outcome::kSame;
    std::string why;         ///< in words: by what measures, or why the golden cannot be read
    std::string missed;      ///< which limits are missed and by how much
    ImageMeasures measures;  ///< outside of what is ignored
    std::vector<PixelRect> ignored;                 ///< in pixels of the golden
    std::string golden_checksum;                    ///< of the file's bytes; empty without a file
    int width_px = 0, height_px = 0;                ///< as drawn
    int golden_width_px = 0, golden_height_px = 0;  ///< 0: none could be read
    std::string drawn_png;
    std::string golden_png;
    /// Where the golden, outside of which it is as drawn, differs at all; and what is drawn there.
    PixelRect changed;
    std::string changed_png;     ///< empty where either can be seen through: then the next is there
    std::string difference_png;  ///< difference_image() of the two
    std::string drawn_path;      ///< where drawn_png was written; empty: nowhere
};

/// Compares; keeps no picture of a still that is the same. Throws Failure(kInput) where the side
/// file of what is ignored is wrong (ignore_file.h).
StillCheck check_still(const DrawnStill& still, const Image& drawn, const GoldenLimits& limits);

}  // namespace carom
