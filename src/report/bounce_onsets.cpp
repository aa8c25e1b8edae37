#include "report/bounce_onsets.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/failure.h"

namespace carom {

namespace {

constexpr double kHop = 0.25e-3;    // s, between two looks at the level
constexpr double kAfter = 1.5e-3;   // s, over which the level of a rise is taken
constexpr double kBefore = 20e-3;   // s before it, with which that is compared
constexpr double kRise = 6;         ///< of the power
constexpr double kQuiet = 1e-7;     ///< of the largest power: nothing below is a bounce
constexpr double kApart = 15e-3;    // s, between two bounces
constexpr double kFitted = 2.5e-3;  // s of a bounce's sound that are laid over the first one's
constexpr double kLargestRatio = 1.005, kSmallestRatio = 0.3;  ///< of successive distances
constexpr double kSteady = 0.06;  ///< by which that ratio may change from bounce to bounce
constexpr std::size_t kMostOnsets = 4000;

struct Onset {
    std::size_t sample = 0;
    double power = 0;
};

/// Sums of the squared differences of neighbouring samples: hum and rumble drop out.
std::vector<double> power_sums(const std::vector<float>& samples) {
    std::vector<double> sums(samples.size() + 1, 0);
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const double d = static_cast<double>(samples[i]) - static_cast<double>(samples[i - 1]);
        sums[i + 1] = sums[i] + d * d;
    }
    return sums;
}

std::vector<Onset> rises(const SoundSamples& sound) {
    const std::vector<double> sums = power_sums(sound.samples);
    const auto count = [&](double seconds) {
        return std::max<std::size_t>(1, static_cast<std::size_t>(seconds * sound.rate));
    };
    const std::size_t hop = count(kHop), after = count(kAfter), before = count(kBefore);
    const auto mean = [&](std::size_t from, std::size_t to) {
        return to > from ? (sums[to] - sums[from]) / static_cast<double>(to - from) : 0.0;
    };
    double largest = 0;
    for (std::size_t i = 0; i + after < sound.samples.size(); i += hop)
        largest = std::max(largest, mean(i, i + after));
    std::vector<Onset> found;
    double best = 0;
    for (std::size_t i = 0; i + after < sound.samples.size(); i += hop) {
        const std::size_t from = i > before ? i - before : 0;
        const double here = mean(i, i + after), floor = mean(from, i);
        if (here < kQuiet * largest || here < kRise * floor) continue;
        const double rise = here / (floor + kQuiet * largest);
        const bool same = !found.empty() && i - found.back().sample < count(kApart);
        if (same && rise <= best) continue;
        best = rise;
        same ? void(found.back() = {i, here}) : found.push_back({i, here});
    }
    return found;
}

/// Where within the window the sound begins: the first sample that rises above what was before.
std::size_t begin_of(const SoundSamples& sound, const Onset& onset) {
    const auto window = static_cast<std::size_t>(2 * kAfter * sound.rate);
    const std::size_t end = std::min(onset.sample + window, sound.samples.size());
    float noise = 0, loudest = 0;
    const std::size_t from = onset.sample > window ? onset.sample - window : 0;
    for (std::size_t i = from; i < onset.sample; ++i)
        noise = std::max(noise, std::abs(sound.samples[i]));
    for (std::size_t i = onset.sample; i < end; ++i)
        loudest = std::max(loudest, std::abs(sound.samples[i]));
    const float limit = std::max(1.5F * noise, 0.3F * loudest);
    for (std::size_t i = onset.sample; i < end; ++i)
        if (std::abs(sound.samples[i]) > limit) return i;
    return onset.sample;
}

/// How far [samples] the sound at `there` has to be moved to lie best over that at `first`.
double shift_between(const SoundSamples& sound, std::size_t first, std::size_t there) {
    const auto length = static_cast<std::ptrdiff_t>(kFitted * sound.rate);
    constexpr std::ptrdiff_t kReach = 8;
    const auto at = [&](std::ptrdiff_t i) {
        return i >= 0 && i < static_cast<std::ptrdiff_t>(sound.samples.size())
                   ? static_cast<double>(sound.samples[static_cast<std::size_t>(i)])
                   : 0.0;
    };
    const auto likeness = [&](std::ptrdiff_t shift) {
        double product = 0, size = 0;
        for (std::ptrdiff_t i = -kReach; i < length; ++i) {
            const double a = at(static_cast<std::ptrdiff_t>(first) + i);
            const double b = at(static_cast<std::ptrdiff_t>(there) + i + shift);
            product += a * b;
            size += b * b;
        }
        return size > 0 ? product / std::sqrt(size) : 0.0;
    };
    std::ptrdiff_t best = 0;
    double highest = likeness(0);
    for (std::ptrdiff_t shift = -kReach; shift <= kReach; ++shift)
        if (const double value = likeness(shift); value > highest) {
            highest = value;
            best = shift;
        }
    // The top of the parabola through three neighbours.
    const double left = likeness(best - 1), right = likeness(best + 1);
    const double bend = left - 2 * highest + right;
    const double part = bend < 0 ? 0.5 * (left - right) / bend : 0.0;
    return static_cast<double>(best) + std::clamp(part, -0.5, 0.5);
}

/// The longest chain of instants whose distances shrink by a steady ratio; of equally long ones the
/// one that lasts longest.
std::vector<std::size_t> longest_series(const std::vector<double>& times) {
    std::vector<std::size_t> best;
    const std::size_t count = times.size();
    for (std::size_t a = 0; a + 2 < count; ++a)
        for (std::size_t b = a + 1; b + 1 < count && b < a + 64; ++b) {
            std::vector<std::size_t> chain = {a, b};
            double distance = times[b] - times[a], ratio = 0;
            for (std::size_t next = b + 1; next < count; ++next) {
                const double now = (times[next] - times[chain.back()]) / distance;
                if (now > kLargestRatio) break;
                if (now < kSmallestRatio) continue;
                if (ratio > 0 && std::abs(now - ratio) > kSteady) continue;
                ratio = now;
                distance = times[next] - times[chain.back()];
                chain.push_back(next);
            }
            const auto span = [&](const std::vector<std::size_t>& c) {
                return c.empty() ? 0.0 : times[c.back()] - times[c.front()];
            };
            if (chain.size() > best.size() ||
                (chain.size() == best.size() && span(chain) > span(best)))
                best = chain;
        }
    return best;
}

}  // namespace

std::vector<double> bounce_onsets(const SoundSamples& sound) {
    const std::vector<Onset> onsets = rises(sound);
    if (onsets.size() > kMostOnsets)
        throw Failure(FailureKind::kInput,
                      "the recording has thousands of sudden sounds: cut out the bounces of one "
                      "ball");
    std::vector<std::size_t> begins;
    std::vector<double> times;
    for (const Onset& onset : onsets) {
        begins.push_back(begin_of(sound, onset));
        times.push_back(static_cast<double>(begins.back()) / sound.rate);
    }
    const std::vector<std::size_t> series = longest_series(times);
    if (series.size() < 3)
        throw Failure(FailureKind::kInput,
                      "no bouncing ball is heard: three sudden sounds at shrinking distances are "
                      "needed");
    std::vector<double> result;
    for (const std::size_t i : series)
        result.push_back((static_cast<double>(begins[i]) +
                          shift_between(sound, begins[series.front()], begins[i])) /
                         sound.rate);
    return result;
}

}  // namespace carom
