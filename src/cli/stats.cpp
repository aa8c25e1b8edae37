#include "cli/stats.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "cli/standard_error.h"
#include "cli/standard_output.h"
#include "core/readable.h"
#include "media/output_file.h"
#include "media/versions.h"
#include "render/versions.h"
#include "report/run_json.h"
#include "sim/record/tunnelling.h"
#include "sim/versions.h"

namespace carom {

namespace {

std::int64_t peak_rss_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return std::int64_t{usage.ru_maxrss} * 1024;
}

nlohmann::ordered_json second_json(const Stats::Second& second) {
    nlohmann::ordered_json differences = nlohmann::ordered_json::object();
    for (const SceneDifference& difference : second.differences)
        differences[difference.path] = {difference.first, difference.second};
    return {{"scene", second.file},
            {"view", second.view == AgainstView::kSide ? "side" : "ghost"},
            {"motion_hash", fmt::format("{:016x}", second.motion_hash)},
            {"steps", second.steps},
            {"impacts", second.impacts},
            {"differences", std::move(differences)}};
}

}  // namespace

void Stats::add_sink(const SinkTimes& times) {
    sinks.convert_cpu_s += times.convert_cpu_s;
    sinks.encode_cpu_s += times.encode_cpu_s;
    sinks.write_cpu_s += times.write_cpu_s;
}

void Stats::add_painter(const Painter& painter) {
    draw_cpu_s += painter.draw_cpu_s();
    read_cpu_s += painter.read_cpu_s();
    renderer = painter.renderer();
    for (const auto& [name, effect] : painter.effects()) effects[name] = {effect.on, effect.why};
}

void Stats::add_second(const FilmedSecond& filmed) {
    second = Second{filmed.run.scene.file, filmed.run.view,       filmed.motion_hash,
                    filmed.report.steps,   filmed.report.impacts, filmed.run.differences};
}

void Stats::add_warnings(const SimulationReport& report, bool quiet) {
    const auto found = report.effects.find(kTunnelling);
    if (found != report.effects.end() && found->second.on && !quiet)
        fmt::print(stderr, "carom: warning: {}\n", found->second.why);
}

void Stats::add_verdict(const Scene& scene, const Motion& motion, bool quiet) {
    verdict = judge_rebound(scene, motion);
    if (verdict && !quiet) say("carom: {}\n", readable_message(verdict_text(scene, *verdict)));
}

void Stats::warn_of_unrest(const SimulationReport& report, bool quiet) {
    if (!report.unrest.empty() && !quiet) say("carom: warning: {}\n", report.unrest);
}

void require_stats_writable(const CommonOptions& options) {
    if (!options.stats_path.empty() && options.stats_path != "-")
        require_writable(options.stats_path, options.overwrite);
}

void write_stats(const CommonOptions& options, const std::string& json) {
    if (options.stats_path == "-")
        write_standard_output(json);
    else
        write_text_file(options.stats_path, json, Durability::kSynced, options.existing());
}

std::map<std::string, std::string> library_versions() {
    std::map<std::string, std::string> versions = {{"carom", CAROM_VERSION}};
    versions.merge(simulation_versions());
    versions.merge(render_versions());
    versions.merge(media_versions());
    return versions;
}

std::string stats_json(const Stats& stats, const SimulationResult* result) {
    using std::chrono::duration;
    using std::chrono::steady_clock;
    nlohmann::ordered_json json;
    json["wall_s"] = duration<double>(steady_clock::now() - stats.start).count();
    json["cpu_s"] = {{"scene", stats.scene_cpu_s},
                     {"sim", stats.sim_cpu_s},
                     {"draw", stats.draw_cpu_s},
                     {"read", stats.read_cpu_s},
                     {"convert", stats.sinks.convert_cpu_s},
                     {"encode", stats.sinks.encode_cpu_s},
                     {"write", stats.sinks.write_cpu_s}};
    if (stats.layers_cpu_s) json["cpu_s"]["layers"] = *stats.layers_cpu_s;
    json["frames"] = stats.frames;
    if (stats.frames_kept > 0) json["frames_kept"] = stats.frames_kept;
    json["steps"] = result != nullptr ? result->report.steps : 0;
    json["impacts"] = result != nullptr ? result->report.impacts : 0;
    std::map<std::string, Effect> effects = stats.effects;
    if (result != nullptr)
        effects.insert(result->report.effects.begin(), result->report.effects.end());
    json["effects"] = effects_json(effects);
    json["renderer"] = stats.renderer;
    json["versions"] = library_versions();
    json["peak_rss_bytes"] = peak_rss_bytes();
    if (result != nullptr) {
        json["motion_hash"] = fmt::format("{:016x}", result->motion.hash());
        if (stats.second) json["against"] = second_json(*stats.second);
        json["balls"] = peaks_json(result->motion);
        if (stats.verdict)
            json["test"] = {{"passes", stats.verdict->passes},
                            {"rebounded", stats.verdict->rebounded},
                            {"height", stats.verdict->height_m},
                            {"time", stats.verdict->time_s}};
    }
    // File names need be no UTF-8, JSON has to be.
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace carom
