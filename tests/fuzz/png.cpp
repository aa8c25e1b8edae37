// PNGs as they are compared, and as `--resume` looks at them.
#include "media/png.h"

#include "core/failure.h"
#include "target.h"

namespace carom::fuzz {

CAROM_FUZZ_TARGET(png) {
    const std::string path = file_with(input, ".png");
    (void)is_whole_png(path, 64, 36, {});
    try {
        (void)read_any_png(path);
    } catch (const Failure&) {
    }
}

}  // namespace carom::fuzz
