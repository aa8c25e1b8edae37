// A sweep's file, and the base scene that it names.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "core/types.h"
#include "render/layers/layer_kind.h"
#include "scene/document.h"
#include "scene/keys.h"
#include "scene/overrides.h"
#include "scene/reader.h"
#include "sweep/file/draw.h"

namespace carom {

enum class SweepMode { kGrid, kZip, kLhs, kRandom };

/// One path that differs between runs.
struct SweepAxis {
    std::string path;
    Draw draw;
    ValueOrigin origin;
};

/// The files of each run.
struct SweepOutputs {
    bool motion = false, events = false, stats = false, scene = false, frames = false;
    std::string film;                 ///< extension, "" for none
    std::string quality;              ///< of the film
    bool stills = false;              ///< at `still_times`, or at those of the scene
    std::vector<double> still_times;  ///< s
    std::vector<LayerKind> layers;

    bool pictures() const { return frames || !film.empty() || stills || !layers.empty(); }
};

/// Balls that are drawn for each run.
struct RandomBalls {
    std::string name;
    Draw count;
    Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< m, of the region
    double gap = 0;                                ///< m
    int attempts = 0;
    std::vector<SweepAxis> each;
    ValueOrigin origin;
};

struct RandomCamera {
    Vec3 to = Vec3::Zero();  ///< m
    Draw distance;           ///< m
    Draw azimuth_deg, elevation_deg;
    std::optional<Draw> fov_deg;
    ValueOrigin origin;
};

struct ResultSpec {
    std::string name, expression;
};

/// Read once; then the same for all runs and threads.
struct Sweep {
    std::string file;  ///< as the user named it
    std::string base_file, base_text;
    Node base;  ///< with the overrides in it
    KeyTable scene_keys;
    std::vector<SweepAxis> axes;
    SweepMode mode = SweepMode::kGrid;
    std::int64_t count = 0;  ///< of lhs and random
    std::uint64_t seed = 0;
    std::vector<RandomBalls> balls;
    std::optional<RandomCamera> camera;
    SweepOutputs outputs;
    std::vector<ResultSpec> results;
    /// Of all that is the same in all runs: base, random, outputs, results, seed, carom's version.
    std::uint64_t fingerprint = 0;
    /// Of the keys of the file: changes also with the axes.
    std::uint64_t file_fingerprint = 0;
};

struct SweepResult {
    std::optional<Sweep> sweep;
    Diagnostics diagnostics;  ///< of the sweep's file and of the base
};

/// Values of the axes that lead nowhere in the base, or are wrong by themselves, are mistakes of
/// the file. Throws Failure(kInput) if the file, or the base, is missing or unreadable.
SweepResult read_sweep_file(const std::string& path, const std::vector<Override>& base_overrides);

/// The report's source that values of the sweep's file carry beside a base scene: add it first.
inline constexpr int kSweepSource = 1;

}  // namespace carom
