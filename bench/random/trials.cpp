#include "trials.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "../clock.h"
#include "motion_checks.h"
#include "motion_difference.h"
#include "random_air.h"
#include "random_laws.h"
#include "random_mixture.h"
#include "random_tracks.h"
#include "scene/reader.h"
#include "scene_text.h"
#include "sim/simulate.h"
#include "transforms.h"

namespace carom::bench {

namespace {

struct Played {
    Scene scene;
    SimulationResult result;
    double cpu_per_s = 0;
};

/// Reads and simulates; nothing if the reader refuses.
std::optional<Played> play(const std::string& text, const char* phase, Watch& watch) {
    SceneResult read = read_scene(text, "scene.yaml");
    if (!read.scene || read.scene->balls.empty()) return std::nullopt;
    const double duration = *read.scene->simulation.duration;
    watch.begin(phase, 0.5 + kHang * duration);
    const double start = cpu_seconds();
    SimulationResult result =
        simulate(*read.scene, {}, [&watch](double time) { watch.reached(time); });
    const double spent = cpu_seconds() - start;
    watch.begin("checks", 60);
    return Played{std::move(*read.scene), std::move(result), spent / duration};
}

void fail(Verdict& verdict, const std::string& symptom, const Worst& worst, const Motion& motion) {
    if (!verdict.symptom.empty()) return;
    verdict.symptom = symptom;
    verdict.value = worst.value;
    verdict.time = worst.time;
    verdict.detail = fmt::format("{:.2g} at {:.9g} s: {}", worst.value, worst.time,
                                 what_happens_at(motion, worst.time));
}

/// What every motion keeps.
Verdict judge_motion(const Played& played) {
    const Motion& motion = played.result.motion;
    Verdict v;
    v.cpu_per_s = played.cpu_per_s;
    v.stepped = played.result.report.steps > 0;
    v.integrated = played.result.report.integrated > 0;
    const std::vector<double> times = check_times(motion);
    const Worst rise = energy_rise(played.scene, motion, times);
    const Worst depth = deepest(played.scene, motion, times);
    v.energy_rise = rise.value;
    v.depth = depth.value;
    double smallest = INFINITY;
    for (const Ball& b : played.scene.balls) smallest = std::min(smallest, b.radius);
    if (!(depth.value <= kSteppedDepth * smallest)) fail(v, "passes through", depth, motion);
    if (!(rise.value <= (v.stepped ? kSteppedEnergy : kEnergyLimit)))
        fail(v, v.stepped ? "energy rises, with steps of ODE" : "energy rises", rise, motion);
    if (!v.stepped && !(depth.value <= kDepthLimit)) fail(v, "too deep", depth, motion);
    if (played.scene.surfaces.empty() && !played.scene.air) {
        const Worst off = momentum_error(played.scene, motion, times);
        v.momentum_error = off.value;
        if (!(off.value <= kMomentumLimit)) fail(v, "momentum", off, motion);
    }
    if (v.cpu_per_s > kCpuLimit) fail(v, "slow", {v.cpu_per_s, 0}, motion);
    return v;
}

Verdict judge_one(const Trial& trial, Watch& watch) {
    const std::optional<Played> played = play(trial.scene, "the scene", watch);
    Verdict refused;
    refused.skipped = true;
    return played ? judge_motion(*played) : refused;
}

/// Instants that are no event's: there velocities jump.
std::vector<double> quiet_times(const Motion& motion, double apart) {
    constexpr int kSamples = 400;
    std::vector<double> times;
    std::size_t next = 0;
    for (int i = 0; i <= kSamples; ++i) {
        const double t = motion.duration * i / kSamples;
        while (next < motion.events.size() && motion.events[next].time < t - apart) ++next;
        if (next < motion.events.size() && motion.events[next].time <= t + apart) continue;
        times.push_back(t);
    }
    return times;
}

Verdict judge_seams(const Trial& trial, Watch& watch) {
    const std::optional<Played> seams = play(trial.scene, "of flush boxes", watch);
    const std::optional<Played> whole = play(trial.other, "as one box", watch);
    Verdict v;
    v.skipped = !seams || !whole;
    if (v.skipped) return v;
    v = judge_motion(*seams);
    if (!v.symptom.empty()) return v;
    const Motion &a = seams->result.motion, &b = whole->result.motion;
    const Transform same;
    Worst worst;
    for (const double t : quiet_times(b, 1e-9)) {
        const StateDifference d = difference(whole->scene, b, a, same, t);
        worst.take(std::max(d.place, d.speed), t);
    }
    v.difference = worst.value;
    if (!(worst.value <= kSeamLimit)) fail(v, "seam differs", worst, a);
    const Worst row = first_other_row(b, a, 1e-10);
    if (row.value > 0) fail(v, "seam's rows differ", row, a);
    return v;
}

/// Of the unmoved motion and that of the transformed scene, against the spread of motions whose
/// starts differ in the last digits.
Verdict judge_transform(const Trial& trial, Watch& watch) {
    constexpr int kPerturbed = 16;  // with few, all may leave one distance as it was
    const Transform transform = transforms(trial.seed)[static_cast<std::size_t>(trial.transform)];
    const double far = transform.shift.cwiseAbs().maxCoeff();
    std::optional<Played> base;
    Verdict v;
    v.skipped = true;
    try {  // what the unmoved scenes do wrong is another kind's
        base = play(trial.scene, "unmoved", watch);
        if (!base) return v;
    } catch (const std::exception&) {
        return v;
    }
    std::vector<Motion> spread;
    for (int i = 0; i < kPerturbed; ++i) {
        const Scene near = perturbed(base->scene, far, trial.seed + static_cast<unsigned>(i));
        std::optional<Played> played = play(scene_text(near), "last digits changed", watch);
        if (!played) return v;
        spread.push_back(std::move(played->result.motion));
    }
    const std::string text = scene_text(transformed(base->scene, transform));
    const std::optional<Played> moved = play(text, "transformed", watch);
    if (!moved) return v;
    v.skipped = false;
    v.cpu_per_s = moved->cpu_per_s;
    const Motion& motion = base->result.motion;
    const Deviation d = deviation(base->scene, motion, spread, moved->result.motion, transform,
                                  quiet_times(motion, 1e-5));
    v.difference = d.ratio;
    if (!(d.ratio <= kSpreadFactor)) {
        fail(v, "differs " + transform.name, {d.ratio, d.time}, motion);
        v.detail = fmt::format("by {:.2g} {} where last digits make {:.2g}; {}", d.found, d.what,
                               d.spread, v.detail);
    }
    if (v.cpu_per_s > kCpuLimit && v.cpu_per_s > 3 * base->cpu_per_s)
        fail(v, "slow", {v.cpu_per_s, 0}, motion);
    return v;
}

std::vector<Trial> make_transforms(std::uint64_t seed) {
    const Scene scene = seed % 4 == 0 ? random_track(seed) : random_mixture(seed, false);
    std::vector<Trial> trials;
    const std::vector<Transform> all = transforms(seed);
    for (std::size_t i = 0; i < all.size(); ++i)
        trials.push_back({seed, scene_text(scene), "", static_cast<int>(i), all[i].name});
    return trials;
}

}  // namespace

std::vector<Kind> all_kinds() {
    const auto seams = [](std::uint64_t seed) {
        const SeamPair pair = random_seams(seed);
        return std::vector<Trial>{{seed, scene_text(pair.seams), scene_text(pair.whole)}};
    };
    const auto tracks = [](std::uint64_t seed) {
        return std::vector<Trial>{{seed, scene_text(random_track(seed))}};
    };
    const auto scenes = [](std::uint64_t seed) {
        return std::vector<Trial>{{seed, scene_text(random_mixture(seed))}};
    };
    const auto shapes = [](std::uint64_t seed) {
        return std::vector<Trial>{{seed, scene_text(random_mixture(seed, true, Bodies::kRimmed))}};
    };
    const auto laws = [](std::uint64_t seed) {
        Scene scene =
            seed % 4 == 0
                ? random_track(seed)
                : random_mixture(seed, true, seed % 2 == 0 ? Bodies::kPlain : Bodies::kRimmed);
        Draw draw(seed + 1'000'000'007);
        add_contact_laws(scene, draw);
        return std::vector<Trial>{{seed, scene_text(scene)}};
    };
    const auto air = [](std::uint64_t seed) {
        return std::vector<Trial>{{seed, scene_text(random_air(seed))}};
    };
    return {{"tracks", tracks, judge_one},
            {"seams", seams, judge_seams},
            {"scenes", scenes, judge_one},
            {"shapes", shapes, judge_one},
            {"laws", laws, judge_one},
            {"air", air, judge_one},
            {"transforms", make_transforms, judge_transform}};
}

}  // namespace carom::bench
