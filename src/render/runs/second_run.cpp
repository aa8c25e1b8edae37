#include "render/runs/second_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/failure.h"
#include "render/draw2d/style.h"

namespace carom {

namespace {

/// The name of a surface that only one of the scenes has, or has there; "" if they are alike.
std::string odd_surface(const Scene& a, const Scene& b) {
    const std::size_t common = std::min(a.surfaces.size(), b.surfaces.size());
    for (std::size_t i = 0; i < common; ++i)
        if (a.surfaces[i].shape != b.surfaces[i].shape) return b.surfaces[i].name;
    if (a.surfaces.size() > common) return a.surfaces[common].name;
    return b.surfaces.size() > common ? b.surfaces[common].name : "";
}

std::string listed_names(const Scene& scene) {
    constexpr std::size_t kMost = 4;
    std::string text;
    for (std::size_t i = 0; i < std::min(kMost, scene.balls.size()); ++i)
        text += (i == 0 ? "" : ", ") + scene.balls[i].name;
    return scene.balls.size() > kMost ? text + ", ..." : text.empty() ? "none" : text;
}

}  // namespace

std::vector<BallPair> paired_balls(const Scene& first, const Scene& second) {
    std::map<std::string, std::size_t> index;
    for (std::size_t i = 0; i < second.balls.size(); ++i) index.emplace(second.balls[i].name, i);
    std::vector<BallPair> pairs;
    for (std::size_t i = 0; i < first.balls.size(); ++i)
        if (const auto found = index.find(first.balls[i].name); found != index.end())
            pairs.push_back({i, found->second});
    return pairs;
}

bool lists_values(const SecondRun& runs) {
    constexpr std::size_t kMost = 3;  // on one picture
    return !runs.differences.empty() && runs.differences.size() <= kMost;
}

std::string shown_path(const SecondRun& runs, const SceneDifference& difference, bool brief) {
    const std::string& path = difference.path;
    for (std::size_t dot = path.rfind('.'); brief && dot != std::string::npos && dot > 0;
         dot = path.rfind('.', dot - 1)) {
        const std::string end = path.substr(dot);
        const auto ends_so = [&](const SceneDifference& other) {
            return ("." + other.path).ends_with(end);
        };
        if (std::count_if(runs.differences.begin(), runs.differences.end(), ends_so) == 1)
            return end.substr(1);
    }
    return path;
}

std::string run_caption(const SecondRun& runs, bool second, bool brief) {
    if (!lists_values(runs)) return second ? runs.second_name : runs.first_name;
    std::string text;
    for (const SceneDifference& difference : runs.differences)
        text +=
            fmt::format("{}{}: {}", text.empty() ? "" : "\n", shown_path(runs, difference, brief),
                        second ? difference.second : difference.first);
    return text;
}

void check_runs(const Scene& first, const SecondRun& second) {
    if (paired_balls(first, second.scene).empty())
        throw Failure(FailureKind::kInput,
                      fmt::format("no ball of '{}' has the name of a ball of '{}', so that nothing "
                                  "can be compared: {} against {}",
                                  first.file, second.scene.file, listed_names(first),
                                  listed_names(second.scene)));
    if (second.view != AgainstView::kGhost) return;
    if (const std::string surface = odd_surface(first, second.scene); !surface.empty())
        throw Failure(FailureKind::kInput,
                      fmt::format("the surface '{}' is not the same in both runs, and ghosts are "
                                  "drawn over one set of surfaces; --against-view side shows both",
                                  surface));
}

bool same_surfaces(const Scene& first, const Scene& second) {
    return odd_surface(first, second).empty();
}

Apart farthest_apart(const Motion& first, const Motion& second, const std::vector<BallPair>& pairs,
                     double t) {
    Apart apart;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const Vec3 a = first.balls[pairs[i].first].at(t).position;
        const double metres = (second.balls[pairs[i].second].at(t).position - a).norm();
        if (metres > apart.metres) apart = {metres, i};
    }
    return apart;
}

std::string distance_text(double metres) {
    struct Unit {
        double metres;
        const char* name;
    };
    if (metres < 1e-6) return metres == 0 ? "0 mm" : "< 0.001 mm";
    const Unit unit = metres < 0.01 ? Unit{1e-3, "mm"}
                      : metres < 1  ? Unit{1e-2, "cm"}
                                    : Unit{1, "m"};
    const double value = metres / unit.metres;
    // Three digits, but no more than a micrometre, and whole numbers in full.
    const int digits = static_cast<int>(std::floor(std::log10(value))) + 1;
    const int decimals = std::clamp(3 - digits, 0, unit.metres == 1 ? 2 : 3);
    return fmt::format("{:.{}f} {}", value, std::min(decimals, value < 1 ? 3 : 2), unit.name);
}

Motion held_until(Motion motion, double duration) {
    for (Trajectory& ball : motion.balls) {
        Trajectory held;
        for (const Piece& piece : ball.pieces())
            if (piece.start <= duration) held.append(piece);
        if (motion.duration < duration) {
            const BallState last = ball.at(motion.duration);
            Piece rest;
            rest.start = motion.duration;
            rest.position = last.position;
            rest.orientation = last.orientation;
            held.append(rest);
        }
        ball = std::move(held);
    }
    motion.duration = duration;
    return motion;
}

BothRuns both_runs(const Scene& scene, const Motion& motion, const SecondRun& second) {
    BothRuns both{scene, motion};
    const auto balls = static_cast<int>(scene.balls.size());
    const auto surfaces = static_cast<int>(scene.surfaces.size());
    Look ghost;
    const Ink ink = ghost_ink(scene.overlay.theme);
    ghost.color = ghost.second_color = {ink.r, ink.g, ink.b};
    both.scene.looks.push_back(ghost);
    std::string name = "ghost";
    if (second.differences.size() == 1) {
        const SceneDifference& only = second.differences.front();
        name = only.path.substr(only.path.rfind('.') + 1) + ": " + only.second;
    }
    for (Ball ball : second.scene.balls) {
        ball.look = static_cast<int>(both.scene.looks.size()) - 1;
        ball.name = name;
        both.scene.balls.push_back(std::move(ball));
    }
    // Surfaces of the second run stand in the second half of the picture, where there is one.
    if (second.view == AgainstView::kSide)
        for (const Surface& surface : second.scene.surfaces) both.scene.surfaces.push_back(surface);

    const Motion& ghosts = second.motion;
    both.motion.ball_names.insert(both.motion.ball_names.end(), ghosts.ball_names.begin(),
                                  ghosts.ball_names.end());
    both.motion.balls.insert(both.motion.balls.end(), ghosts.balls.begin(), ghosts.balls.end());
    both.motion.peaks.resize(both.motion.balls.size());
    for (Event event : ghosts.events) {
        if (event.time > motion.duration) break;
        event.ball += balls;
        event.other.index += event.other.is_surface ? surfaces : balls;
        both.motion.events.push_back(event);
    }
    std::stable_sort(both.motion.events.begin(), both.motion.events.end(),
                     [](const Event& a, const Event& b) { return a.time < b.time; });

    if (both.scene.overlay.plot) {
        std::vector<int>& plotted = both.scene.overlay.plot->balls;
        const std::vector<int> own = plotted;
        for (const BallPair& pair : paired_balls(scene, second.scene))
            if (std::find(own.begin(), own.end(), static_cast<int>(pair.first)) != own.end())
                plotted.push_back(balls + static_cast<int>(pair.second));
    }
    return both;
}

}  // namespace carom
