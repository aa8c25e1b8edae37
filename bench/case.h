// A hard case: a scene, the closed form that its motion must follow, and how far a motion is from
// it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "motion/motion.h"
#include "scene/reader.h"
#include "scene/scene.h"

namespace carom::bench {

/// "To 1e-9" of docs/accuracy.md.
inline constexpr double kLimit = 1e-9;

/// One number of a motion beside its reference.
struct Measure {
    std::string what;       ///< "peak 3"
    double value = 0;       ///< of the motion; not finite: it does not have it
    double reference = 0;   ///< evaluated from the formula
    double scale = 1;       ///< what the error is relative to
    double limit = kLimit;  ///< of error()
    std::string how;        ///< what it means when this is off, in words; empty: the numbers

    double error() const;
};

/// `value` against `reference`, relative to the latter.
Measure relative(std::string what, double value, double reference, double limit = kLimit);
/// Relative to `scale`: where the reference is 0, or small beside what was computed with.
Measure scaled(std::string what, double value, double reference, double scale,
               double limit = kLimit);
/// The length of a difference of vectors, relative to `scale`.
Measure vector_measure(std::string what, const Vec3& value, const Vec3& reference, double scale,
                       double limit = kLimit);

using Measures = std::vector<Measure>;

/// One motion of a case: the scene with overrides (as with --set), and changes that they cannot
/// say.
struct Run {
    std::vector<Override> overrides;
    std::function<Measures(const Scene&, const Motion&)> measure;
    std::function<void(Scene&)> prepare = {};
    bool quick = true;     ///< also in --quick
    bool twice = false;    ///< a second run must give the same motion, bit for bit
    bool refused = false;  ///< carom's reader must refuse the scene as overridden; engines that do
                           ///< not read scenes get it through `prepare`
};

struct Case {
    std::string id;         ///< "H1"
    std::string title;      ///< for the table
    std::string scene;      ///< file below scenes/hard, without ".yaml"
    std::string reference;  ///< the formula, for the table
    std::vector<Run> runs;
};

/// H1 ... H35, in order.
std::vector<Case> all_cases();

// The parts of all_cases().
std::vector<Case> bounce_cases();
std::vector<Case> impact_cases();
std::vector<Case> chain_cases();
std::vector<Case> friction_cases();
std::vector<Case> contact_cases();
std::vector<Case> seam_cases();
std::vector<Case> surface_cases();

/// PATH=VALUE with all digits.
Override set(const std::string& path, double value);
Override set(const std::string& path, const Vec3& value);

}  // namespace carom::bench
