#include "cli/sweep_estimate.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <array>
#include <filesystem>
#include <set>

#include "cli/progress.h"
#include "cli/standard_output.h"
#include "cli/sweep_run.h"
#include "core/temporary_folder.h"
#include "sweep/runs/run_maker.h"

namespace carom {

namespace {

namespace fs = std::filesystem;

double process_cpu_s() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// What files and folders take on the disk, in blocks.
double disk_bytes(const fs::path& folder) {
    constexpr double kBlock = 512;  // of st_blocks
    double bytes = 0;
    const auto add = [&](const fs::path& path) {
        struct stat info = {};
        if (::stat(path.c_str(), &info) == 0) bytes += kBlock * static_cast<double>(info.st_blocks);
    };
    add(folder);
    for (const auto& entry : fs::recursive_directory_iterator(folder)) add(entry.path());
    return bytes;
}

std::string bytes_text(double bytes) {
    constexpr std::array kUnits = {"B", "kB", "MB", "GB", "TB"};
    std::size_t unit = 0;
    for (; bytes >= 1000 && unit + 1 < kUnits.size(); ++unit) bytes /= 1000;
    return fmt::format("{:.3g} {}", bytes, kUnits[unit]);
}

void list_runs(const Interrupt& interrupt, const Sweep& sweep, const Plan& plan,
               const SweepSlice& slice) {
    std::string text;
    constexpr std::size_t kPart = 1 << 16;
    for (std::int64_t run = slice.first; run < slice.last; ++run) {
        text += fmt::format("{}", run_folder(run));
        const std::vector<Node> values = plan.values(run);
        for (std::size_t i = 0; i < values.size(); ++i)
            text += fmt::format(" {}={}", sweep.axes[i].path, flow_text(values[i]));
        text += '\n';
        if (text.size() < kPart) continue;
        interrupt.check();
        write_standard_output(text);
        text.clear();
    }
    write_standard_output(text);
}

struct Sample {
    int runs = 0, failed = 0;
    double cpu_s = 0, disk_bytes = 0;  ///< of one run
};

Sample take_sample(const Interrupt& interrupt, const Sweep& sweep, const Plan& plan,
                   const SweepSlice& slice) {
    const TemporaryFolder folder(FailureKind::kRun);
    RunMaker maker(sweep, plan, folder.path().string());
    const std::int64_t count = slice.last - slice.first;
    std::set<std::int64_t> chosen;
    constexpr std::int64_t kMost = 5;
    for (std::int64_t i = 0; i < kMost; ++i)
        chosen.insert(slice.first + (2 * i + 1) * count / (2 * kMost));
    // The first one loads drivers and compiles shaders, which is done once.
    maker.make(*chosen.begin(), interrupt.token());
    Sample sample;
    const double begin = process_cpu_s();
    for (const std::int64_t run : chosen) {
        sample.failed += maker.make(run, interrupt.token()).status != RunStatus::kDone;
        ++sample.runs;
    }
    sample.cpu_s = (process_cpu_s() - begin) / sample.runs;
    for (const std::int64_t run : chosen)
        sample.disk_bytes += disk_bytes(folder.path() / run_folder(run)) / sample.runs;
    return sample;
}

}  // namespace

void estimate_sweep(const SweepOptions& options, const Interrupt& interrupt, const Sweep& sweep,
                    const Plan& plan) {
    const SweepSlice slice = sweep_slice(options.slice, plan.count());
    list_runs(interrupt, sweep, plan, slice);
    const auto count = static_cast<double>(slice.last - slice.first);
    if (count == 0) return;
    const Sample sample = [&] {
        try {
            return take_sample(interrupt, sweep, plan, slice);
        } catch (const RunMaker::Stopped&) {
            throw Interrupted{};
        }
    }();
    const int jobs = sweep_jobs(options, sweep, plan);
    write_standard_output(fmt::format(
        "{:.0f} runs, about {} with {} at once, about {} on disk; of {} runs each took {:.3g} ms "
        "of a processor and {}{}\n",
        count, format_duration(count * sample.cpu_s / jobs), jobs,
        bytes_text(count * sample.disk_bytes), sample.runs, 1e3 * sample.cpu_s,
        bytes_text(sample.disk_bytes),
        sample.failed > 0 ? fmt::format(", and {} failed", sample.failed) : ""));
}

}  // namespace carom
