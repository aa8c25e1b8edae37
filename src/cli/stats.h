// What --stats writes: where the time went, what was modelled and drawn, and what came out.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "cli/against.h"
#include "media/frame_sink.h"
#include "render/painter.h"
#include "render/runs/rebound_verdict.h"
#include "sim/simulate.h"

namespace carom {

struct Stats {
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    double scene_cpu_s = 0;
    double sim_cpu_s = 0;
    double draw_cpu_s = 0;
    double read_cpu_s = 0;
    std::optional<double> layers_cpu_s;  ///< where layers are written
    SinkTimes sinks;
    std::int64_t frames = 0;
    std::string renderer;
    std::optional<ReboundVerdict> verdict;  ///< of the scene's test, if it has one
    std::map<std::string, Effect> effects;  ///< of the simulation and of the picture

    /// A second run, in a film of two.
    struct Second {
        std::string file;
        AgainstView view = AgainstView::kGhost;
        std::uint64_t motion_hash = 0;
        std::int64_t steps = 0, impacts = 0;
        std::vector<SceneDifference> differences;
    };
    std::optional<Second> second;

    void add_sink(const SinkTimes& times);
    void add_painter(const Painter& painter);
    void add_second(const FilmedSecond& filmed);
    /// Says on standard error what of the simulation may be wrong.
    static void add_warnings(const SimulationReport& report, bool quiet);
    /// Judges the scene's test, if it has one, and says the verdict on standard error.
    void add_verdict(const Scene& scene, const Motion& motion, bool quiet);
    /// Warns on standard error where a motion until rest ended before all rested.
    static void warn_of_unrest(const SimulationReport& report, bool quiet);
};

/// The JSON text; `result` is empty only when nothing was simulated.
std::string stats_json(const Stats& stats, const SimulationResult* result);

/// Refuses --stats where it cannot be written, and writes it; "-" is standard output.
void require_stats_writable(const CommonOptions& options);
void write_stats(const CommonOptions& options, const std::string& json);

/// Versions of carom and its libraries, name -> version.
std::map<std::string, std::string> library_versions();

}  // namespace carom
