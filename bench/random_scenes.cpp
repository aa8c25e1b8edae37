// Random scenes and what their motions must keep, whatever the scene.
//   random_scenes tracks|seams|scenes|shapes|laws|air|transforms [--count N] [--seed S]
//                 [--failures DIR]
//                 [--reduce TRIES] [-v]
// Seeds are S, S + 1, ...; each scene runs in a child, so that a hang or a crash is counted. Prints
// the failures by symptom, and the worst values of what held; --failures writes their scenes,
// reduced by up to TRIES runs each, and failures.tsv. Exit 1 if any failed.
#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

#include "command_line.h"
#include "random/reduce.h"
#include "random/scene_text.h"
#include "random/transforms.h"
#include "random/trials.h"
#include "scene/reader.h"

namespace {

using namespace carom;
using namespace carom::bench;

struct Options {
    std::string kind;
    int count = 50;
    std::uint64_t seed = 1;
    std::filesystem::path failures;
    int tries = 0;
    bool verbose = false;
};

Kind kind_named(const std::string& name) {
    for (Kind& kind : all_kinds())
        if (kind.name == name) return kind;
    throw std::invalid_argument(
        "needs one of tracks, seams, scenes, shapes, laws, air, transforms");
}

/// What came of all trials.
struct Tally {
    int run = 0, skipped = 0, stepped = 0, integrated = 0;
    std::map<std::string, int> symptoms;
    Verdict worst;  ///< the largest of each measure among those that held
    double worst_stepped_rise = 0;

    void add(const Verdict& v) {
        ++(v.skipped ? skipped : run);
        if (v.skipped) return;
        if (!v.symptom.empty()) {
            ++symptoms[v.symptom];
            return;
        }
        stepped += v.stepped;
        integrated += v.integrated;
        double& rise = v.stepped ? worst_stepped_rise : worst.energy_rise;
        rise = std::max(rise, v.energy_rise);
        if (!v.stepped) worst.depth = std::max(worst.depth, v.depth);
        worst.cpu_per_s = std::max(worst.cpu_per_s, v.cpu_per_s);
        worst.momentum_error = std::max(worst.momentum_error, v.momentum_error);
        worst.difference = std::max(worst.difference, v.difference);
    }
    int failed() const {
        int sum = 0;
        for (const auto& [symptom, count] : symptoms) sum += count;
        return sum;
    }
};

void write_text(const std::filesystem::path& path, const std::string& text) {
    std::ofstream file(path);
    file << text;
    if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

/// "energy rises" -> "energy_rises".
std::string file_word(std::string text) {
    for (char& c : text)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return text;
}

/// One failure: its scenes, and a line of failures.tsv (symptom, file, seed, bodies, detail).
void write_failure(const Options& options, const Trial& trial, const Verdict& v) {
    const std::string stem = fmt::format("{}_{}", file_word(v.symptom), trial.seed);
    const std::filesystem::path folder = options.failures;
    const std::string head = fmt::format("# {} of seed {}{}: {}\n", options.kind, trial.seed,
                                         trial.about.empty() ? "" : ", " + trial.about, v.symptom);
    write_text(folder / (stem + ".yaml"), head + trial.scene);
    if (!trial.other.empty()) write_text(folder / (stem + "_whole.yaml"), trial.other);
    const Scene scene = *read_scene(trial.scene, stem).scene;
    if (trial.transform >= 0) {
        const Transform t = transforms(trial.seed)[static_cast<std::size_t>(trial.transform)];
        write_text(folder / fmt::format("{}_{}.yaml", stem, file_word(t.name)),
                   scene_text(transformed(scene, t)));
    }
    std::ofstream list(folder / "failures.tsv", std::ios::app);
    list << fmt::format("{}\t{}.yaml\t{}\t{}\t{}\n", v.symptom, stem, trial.seed,
                        scene.balls.size() + scene.surfaces.size(), v.detail);
}

void report(const Options& options, const Tally& tally) {
    fmt::print("{}: {} run ({} refused by the reader), {} failed\n", options.kind, tally.run,
               tally.skipped, tally.failed());
    for (const auto& [symptom, count] : tally.symptoms) fmt::print("  {:5} {}\n", count, symptom);
    fmt::print(
        "of those that held: {} with islands integrated, {} with steps of ODE; worst rise of "
        "energy {:.1e} ({:.1e} with steps), depth {:.1e} m, momentum {:.1e}, difference {:.2g}, "
        "CPU {:.2g} s a second\n",
        tally.integrated, tally.stepped, tally.worst.energy_rise, tally.worst_stepped_rise,
        tally.worst.depth, tally.worst.momentum_error, tally.worst.difference,
        tally.worst.cpu_per_s);
}

int run(const Options& options) {
    const Kind kind = kind_named(options.kind);
    if (!options.failures.empty()) std::filesystem::create_directories(options.failures);
    Tally tally;
    for (int i = 0; i < options.count; ++i)
        for (Trial& trial : kind.make(options.seed + static_cast<std::uint64_t>(i))) {
            Verdict v = run_guarded([&](Watch& watch) { return kind.judge(trial, watch); });
            tally.add(v);
            if (options.verbose || !v.symptom.empty())
                fmt::print("{} {} {}: {} {}\n", options.kind, trial.seed, trial.about,
                           v.skipped ? "refused" : v.symptom, v.detail);
            std::fflush(stdout);
            if (v.symptom.empty() || options.failures.empty()) continue;
            const Reduced reduced = reduce(kind, trial, v, options.tries);
            write_failure(options, reduced.trial, reduced.verdict);
        }
    report(options, tally);
    return tally.failed() > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App line({}, "random_scenes");
    line.add_option("kind", options.kind, "tracks, seams, scenes, shapes, laws, air or transforms");
    line.add_option("--count", options.count, "trials");
    line.add_option("--seed", options.seed, "of the first one");
    line.add_option("--failures", options.failures, "folder for the scenes that fail");
    line.add_option("--reduce", options.tries, "tries to make a failing scene smaller");
    line.add_flag("-v", options.verbose, "say more");
    return run_line(line, argc, argv, [&] { return run(options); });
}
