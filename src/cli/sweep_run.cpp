#include "cli/sweep_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "cli/exit_codes.h"
#include "cli/film_limits.h"
#include "cli/film_plan.h"
#include "cli/standard_error.h"
#include "cli/stats.h"
#include "core/in_parallel.h"
#include "core/readable.h"
#include "media/output_folder.h"
#include "scene/film_clock.h"
#include "sim/versions.h"
#include "sweep/file/results.h"
#include "sweep/runs/index.h"
#include "sweep/runs/run_files.h"
#include "sweep/runs/run_maker.h"
#include "sweep/runs/run_many.h"

namespace carom {

namespace {

/// Versions that have a say in what the runs are.
std::map<std::string, std::string> versions_of(const Sweep& sweep) {
    std::map<std::string, std::string> versions = {{"carom", CAROM_VERSION}};
    if (sweep.outputs.pictures()) versions = library_versions();
    versions.merge(simulation_versions());
    if (!sweep.results.empty()) versions["muparser"] = expression_library_version();
    return versions;
}

/// Runs of the slice that are not there as they should be.
std::vector<std::int64_t> missing_runs(const std::string& dir, const Sweep& sweep, const Plan& plan,
                                       const SweepSlice& slice) {
    const std::vector<bool> there = find_run_folders(dir, slice.first, slice.last);
    std::vector<char> settled(there.size());
    constexpr std::int64_t kBlock = 256;  // worth handing to a thread
    const auto count = static_cast<std::int64_t>(there.size());
    in_parallel(static_cast<int>((count + kBlock - 1) / kBlock), [&](int block) {
        const std::int64_t end = std::min(count, (block + 1) * kBlock);
        for (std::int64_t i = block * kBlock; i < end; ++i) {
            const auto place = static_cast<std::size_t>(i);
            if (!there[place]) continue;
            const std::int64_t run = slice.first + i;
            settled[place] = is_settled(read_record(sweep, dir, run), dir,
                                        run_fingerprint(sweep, run, plan.values(run)));
        }
    });
    std::vector<std::int64_t> todo;
    for (std::int64_t i = 0; i < count; ++i)
        if (settled[static_cast<std::size_t>(i)] == 0) todo.push_back(slice.first + i);
    return todo;
}

/// The first run whose values make a scene, to know how large pictures are.
std::optional<Scene> some_scene(const Sweep& sweep, const Plan& plan) {
    constexpr std::int64_t kMostLooks = 10;
    for (std::int64_t run = 0; run < std::min(plan.count(), kMostLooks); ++run)
        if (RunScene made = make_run_scene(sweep, plan.values(run), run); made.scene)
            return std::move(made.scene);
    return std::nullopt;
}

/// Bytes that a process takes which draws such pictures.
double bytes_of_worker(const Sweep& sweep, const Scene& scene) {
    constexpr double kProgram = 200e6;  // with driver and encoder, measured (docs/scale.md)
    std::vector<OutputRequest> outputs;
    if (!sweep.outputs.film.empty()) outputs.push_back({"film." + sweep.outputs.film, ""});
    if (sweep.outputs.frames || outputs.empty()) outputs.push_back({"frames/", ""});
    EncodingOptions encoding;
    encoding.threads = 1;
    return kProgram + film_needs(outputs, scene, encoding, 1).memory_bytes;
}

/// Tells how far the runs are.
class SweepProgress {
  public:
    SweepProgress(const SweepOptions& options, const Interrupt& interrupt, std::int64_t total)
        : progress_(options.common.progress_mode(), interrupt, kSweeping, total) {}

    void tell(const RunOutcome* outcome) {
        if (outcome != nullptr) ++ended_;
        progress_.update(static_cast<double>(ended_));
    }
    std::int64_t ended() const { return ended_; }

  private:
    std::int64_t ended_ = 0;
    Progress progress_;
};

/// How many ended.
std::int64_t make_runs(const SweepOptions& options, const Interrupt& interrupt, const Sweep& sweep,
                       const Plan& plan, const std::vector<std::int64_t>& todo) {
    std::int64_t ended = 0;
    if (todo.empty()) return ended;
    {
        SweepProgress progress(options, interrupt, static_cast<std::int64_t>(todo.size()));
        const ManyRuns runs{todo,
                            sweep_jobs(options, sweep, plan),
                            options.fail_fast,
                            interrupt.token(),
                            [&] { return RunMaker(sweep, plan, options.dir); },
                            [&](const RunOutcome* outcome) { progress.tell(outcome); }};
        if (sweep.outputs.pictures())
            run_in_processes(runs);
        else
            run_in_threads(runs);
        ended = progress.ended();
    }
    if (interrupt.requested()) {
        interrupt.reached(fmt::format("after {} of {} runs", ended, todo.size()));
        throw Interrupted{};
    }
    return ended;
}

void say_failed(const IndexCounts& counts) {
    for (const RunRecord& record : counts.first_failed)
        say("carom: run {} {}: {}\n", record.run, run_status_name(record.status),
            readable_message(record.reason));
    const auto named = static_cast<std::int64_t>(counts.first_failed.size());
    if (counts.failed > named)
        say("carom: {} more failed; the run.json of each says why\n", counts.failed - named);
}

int exit_code(const IndexCounts& counts) {
    return counts.failed + counts.missing > 0 ? kExitFailed : kExitDone;
}

}  // namespace

SweepSlice sweep_slice(const std::string& text, std::int64_t count) {
    if (text.empty()) return {0, count};
    const FrameRanges part = parse_chunk(text, count, "--slice");
    if (part.empty()) return {};
    return {part.front(), part.back() + 1};
}

int sweep_jobs(const SweepOptions& options, const Sweep& sweep, const Plan& plan) {
    if (options.jobs > 0) return options.jobs;
    const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    if (!sweep.outputs.pictures()) return processors;
    const std::optional<Scene> scene = some_scene(sweep, plan);
    const double free = free_memory_bytes();
    if (!scene || free == 0) return processors;
    constexpr double kPart = 0.8;  // others want some as well
    const double room = kPart * free / bytes_of_worker(sweep, *scene);
    return std::clamp(static_cast<int>(std::min(room, 1e6)), 1, processors);
}

int index_sweep(const SweepOptions& options, const Sweep& sweep, const Plan& plan) {
    const IndexCounts counts = write_index(sweep, plan, options.dir, versions_of(sweep));
    if (!options.common.quiet)
        say("carom: {} runs done, {} failed, {} missing: {}/index.csv\n", counts.done,
            counts.failed, counts.missing, readable(options.dir));
    say_failed(counts);
    return exit_code(counts);
}

int run_sweep(const SweepOptions& options, const Interrupt& interrupt, const Sweep& sweep,
              const Plan& plan) {
    if (const std::optional<Scene> scene = some_scene(sweep, plan))
        require_run_files(sweep.outputs, *scene);
    const SweepSlice slice = sweep_slice(options.slice, plan.count());
    prepare_folder(options.dir);
    const std::vector<std::int64_t> todo = missing_runs(options.dir, sweep, plan, slice);
    const std::int64_t made = make_runs(options, interrupt, sweep, plan, todo);
    // Processes that were killed with an earlier command may have ended only now.
    if (!todo.empty()) find_run_folders(options.dir, slice.first, slice.last);
    if (!options.common.quiet)
        say("carom: {} runs made, {} were there\n", made,
            slice.last - slice.first - static_cast<std::int64_t>(todo.size()));
    if (options.slice.empty()) return index_sweep(options, sweep, plan);
    const IndexCounts counts = count_runs(sweep, plan, options.dir, slice.first, slice.last);
    say_failed(counts);
    return exit_code(counts);
}

}  // namespace carom
