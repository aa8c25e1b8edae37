#include "report/film_sound.h"

#include <cmath>

namespace carom {

FramesSound sound_of_frames(SoundSamples whole, const Film& film, const FrameRanges& frames) {
    if (frames.empty()) return {};
    if (frames.size() == frames.back() - frames.front() + 1)
        return {std::move(whole), frames.front()};
    const double frame = whole.rate * film.fps.denominator / film.fps.numerator;  // samples
    const auto begin_of = [&](std::int64_t k) {
        return std::llround(static_cast<double>(k) * frame);
    };
    FramesSound cut;
    cut.samples.rate = whole.rate;
    std::int64_t k = 0;
    for (const std::int64_t shown : frames) {
        const long long count = begin_of(k + 1) - begin_of(k), from = begin_of(shown);
        for (long long i = from; i < from + count; ++i) {
            const auto at = static_cast<std::size_t>(i);
            cut.samples.samples.push_back(at < whole.samples.size() ? whole.samples[at] : 0.0F);
        }
        ++k;
    }
    return cut;
}

}  // namespace carom
