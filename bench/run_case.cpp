#include "run_case.h"

#include <fmt/core.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <vector>

#include "clock.h"
#include "core/diagnostics.h"
#include "core/failure.h"
#include "trajectory_measures.h"

namespace carom::bench {

namespace {

/// A child's answer, in memory that it shares with its parent. Written whole but for `reached`.
struct Shared {
    volatile double reached = 0;  ///< s of the motion
    bool finished = false;
    Outcome::Kind kind = Outcome::Kind::kCrashed;
    double error = 0, limit = 0, cpu_s = 0;
    std::int64_t steps = 0;
    std::array<char, 400> what{}, how{};
};

constexpr std::size_t kMemory = 6ull << 30;  // bytes of address space of one run

void copy_text(const std::string& from, std::array<char, 400>& to) {
    std::strncpy(to.data(), from.c_str(), to.size() - 1);
}

struct Loaded {
    std::optional<Scene> scene;
    std::string refusal;
};

Loaded load(const Case& one, const Run& run, bool refusable) {
    const std::string file = std::string(CAROM_SOURCE_DIR "/scenes/hard/") + one.scene + ".yaml";
    const bool bypass = run.refused && !refusable;
    SceneResult read = read_scene_file(file, bypass ? std::vector<Override>{} : run.overrides);
    if (!read.scene) {
        std::string text;
        for (const Diagnostic& d : read.diagnostics.items())
            if (d.severity == Severity::kError) text += d.message + "; ";
        return {std::nullopt, text};
    }
    if (run.prepare && (bypass || !run.refused)) run.prepare(*read.scene);
    return {std::move(read.scene), ""};
}

/// The worst of the measures, in words.
void judge(const Measures& measures, Shared& out) {
    const auto ratio = [](const Measure& m) {
        const double error = m.error();
        return m.limit > 0 ? error / m.limit : error > 0 ? INFINITY : 0;
    };
    const auto worst =
        std::max_element(measures.begin(), measures.end(),
                         [&](const Measure& a, const Measure& b) { return ratio(a) < ratio(b); });
    out.error = worst->error();
    out.limit = worst->limit;
    std::string words = fmt::format("{}: {:.3g}", worst->what, worst->value);
    if (worst->reference != 0) words += fmt::format(" instead of {:.3g}", worst->reference);
    if (!std::isfinite(worst->value)) words = worst->what + ": there is none";
    if (!worst->how.empty() && out.error > std::max(0.01, out.limit))
        copy_text(worst->how, out.how);
    copy_text(words, out.what);
}

/// Median of a few runs, until they have taken a tenth of a second.
double median_cpu(const Engine& engine, const Scene& scene, double first) {
    std::vector<double> seconds = {first};
    double sum = first;
    while (sum < 0.1 && seconds.size() < 101) {
        const double start = cpu_seconds();
        engine.simulate(scene, {});
        seconds.push_back(cpu_seconds() - start);
        sum += seconds.back();
    }
    std::nth_element(seconds.begin(), seconds.begin() + static_cast<long>(seconds.size() / 2),
                     seconds.end());
    return seconds[seconds.size() / 2];
}

void simulate_and_judge(const Run& run, const Engine& engine, const Scene& scene, Shared& out) {
    const double start = cpu_seconds();
    const SimulationResult result =
        engine.simulate(scene, [&out](double time) { out.reached = time; });
    out.cpu_s = cpu_seconds() - start;
    out.reached = result.motion.duration;
    out.steps = result.report.steps;
    out.kind = Outcome::Kind::kDone;
    Measures measures = run.measure(scene, result.motion);
    if (run.twice) {
        const SimulationResult again = engine.simulate(scene, {});
        measures.push_back(
            scaled("second run differs", again.motion.hash() != result.motion.hash(), 0, 1, 0));
    }
    judge(measures, out);
    // A better word than "off" where the motion is wrong as a whole.
    if (std::isfinite(out.error) && out.error > out.limit && out.how[0] == '\0')
        copy_text(diagnosis(scene, result.motion), out.how);
}

void child(const Case& one, const Run& run, const Engine& engine, bool repeat, Shared& out) {
    const Loaded loaded = load(one, run, engine.family == "exact");
    if (!loaded.scene) {
        const bool expected = run.refused && loaded.refusal.find("'a'") != std::string::npos &&
                              loaded.refusal.find("'b'") != std::string::npos &&
                              loaded.refusal.find("0.01") != std::string::npos;
        out.kind = expected ? Outcome::Kind::kRefused : Outcome::Kind::kFailed;
        copy_text(loaded.refusal, out.what);
        return;
    }
    try {
        simulate_and_judge(run, engine, *loaded.scene, out);
        if (repeat) out.cpu_s = median_cpu(engine, *loaded.scene, out.cpu_s);
    } catch (const std::bad_alloc&) {
        out.kind = Outcome::Kind::kFailed;
        copy_text("out of memory", out.what);
    } catch (const std::exception& error) {
        out.kind = Outcome::Kind::kFailed;
        copy_text(error.what(), out.what);
    }
}

void set_limits(double cpu_limit_s) {
    rlimit memory{kMemory, kMemory};
    setrlimit(RLIMIT_AS, &memory);
    itimerval timer{};
    timer.it_value.tv_sec = static_cast<time_t>(cpu_limit_s);
    timer.it_value.tv_usec =
        static_cast<suseconds_t>(1e6 * (cpu_limit_s - std::floor(cpu_limit_s)));
    setitimer(ITIMER_PROF, &timer, nullptr);  // ends the process with SIGPROF
}

Outcome outcome_of(const Shared& shared, int status, double cpu_limit_s) {
    Outcome out;
    out.kind = shared.kind;
    out.error = shared.error;
    out.limit = shared.limit;
    out.cpu_s = shared.cpu_s;
    out.simulated_s = shared.reached;
    out.steps = shared.steps;
    out.what = shared.what.data();
    out.how = shared.how.data();
    if (shared.finished) return out;
    const bool cut = WIFSIGNALED(status) && WTERMSIG(status) == SIGPROF;
    out.kind = cut ? Outcome::Kind::kCut : Outcome::Kind::kCrashed;
    out.error = INFINITY;
    out.cpu_s = cpu_limit_s;
    out.what = cut ? fmt::format("cut after {:g} s of CPU time, past t = {:.3g} s", cpu_limit_s,
                                 out.simulated_s)
                   : fmt::format("died of signal {}", WIFSIGNALED(status) ? WTERMSIG(status) : 0);
    return out;
}

}  // namespace

Outcome run_case(const Case& one, const Run& run, const Engine& engine, double cpu_limit_s,
                 bool repeat) {
    void* memory =
        mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw Failure(FailureKind::kRun, "no shared memory for a run");
    auto* shared = new (memory) Shared;
    const pid_t pid = fork();
    if (pid < 0) throw Failure(FailureKind::kRun, "cannot start a process for a run");
    if (pid == 0) {
        set_limits(cpu_limit_s);
        child(one, run, engine, repeat, *shared);
        shared->finished = true;
        _exit(0);
    }
    int status = 0;
    waitpid(pid, &status, 0);
    const Outcome out = outcome_of(*shared, status, cpu_limit_s);
    munmap(memory, sizeof(Shared));
    return out;
}

}  // namespace carom::bench
