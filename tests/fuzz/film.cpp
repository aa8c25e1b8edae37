// Films as they are compared: the first frames, and their times.
#include "core/failure.h"
#include "media/film_reader.h"
#include "target.h"

namespace carom::fuzz {

CAROM_FUZZ_TARGET(film) {
    constexpr int kFrames = 4;
    const std::string path = file_with(input, ".mkv");
    try {
        FilmReader reader(path);
        Image frame;
        for (int k = 0; k < kFrames && reader.next(frame); ++k) (void)reader.time_s();
    } catch (const Failure&) {
    }
}

}  // namespace carom::fuzz
