#include "report/impact_sound.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/failure.h"
#include "scene/film_clock.h"

namespace carom {

namespace {

constexpr double kRate = 48'000;                   // 1/s
constexpr double kPitchSpeed = 64;                 // m/s
constexpr double kLowest = 120, kHighest = 9'000;  // Hz
constexpr double kPeriods = 8;
constexpr double kAudible = 1e-4;  ///< of the largest
constexpr double kLoudest = 0.8;
constexpr double kTail = 0.3;               ///< s after the end: what begins there is heard out
constexpr double kLongestSound = 3600 * 6;  // s

double smaller_radius(const Scene& scene, const Event& impact) {
    double radius = scene.balls[static_cast<std::size_t>(impact.ball)].radius;
    if (!impact.other.is_surface)
        radius = std::min(radius, scene.balls[static_cast<std::size_t>(impact.other.index)].radius);
    return radius;
}

void add_click(SoundSamples& sound, double at, double level, double pitch) {
    const double seconds = kPeriods / pitch;
    const double end = at + seconds * std::log(level / kAudible);
    const auto first = static_cast<std::size_t>(std::ceil(at * kRate));
    for (std::size_t i = first; i < sound.samples.size(); ++i) {
        const double s = static_cast<double>(i) / kRate - at;
        if (at + s > end) break;
        sound.samples[i] += static_cast<float>(level * std::exp(-s / seconds) *
                                               std::cos(2 * std::numbers::pi * pitch * s));
    }
}

}  // namespace

SoundSamples impact_sound(const Scene& scene, const Motion& motion) {
    const double seconds = film_time(scene.film, motion.duration);
    if (!(seconds <= kLongestSound))
        throw Failure(FailureKind::kInput, fmt::format("{:.0f} s of sound; at most {:.0f} are made",
                                                       seconds, kLongestSound));
    SoundSamples sound;
    sound.rate = kRate;
    sound.samples.resize(static_cast<std::size_t>(std::ceil((seconds + kTail) * kRate)));
    double largest = 0;
    for (const Event& e : motion.events)
        if (e.kind == EventKind::kImpact) largest = std::max(largest, e.impulse);
    for (const Event& e : motion.events) {
        if (e.kind != EventKind::kImpact || e.time < scene.film.start) continue;
        const double level = e.impulse / largest;
        if (!(level > kAudible)) continue;
        const double pitch = kPitchSpeed / smaller_radius(scene, e);
        add_click(sound, film_time(scene.film, e.time), level,
                  std::clamp(pitch, kLowest, kHighest));
    }
    float peak = 0;
    for (const float s : sound.samples) peak = std::max(peak, std::abs(s));
    if (peak > 0)
        for (float& s : sound.samples) s *= static_cast<float>(kLoudest) / peak;
    return sound;
}

}  // namespace carom
