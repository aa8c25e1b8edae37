#include "reduce.h"

#include <algorithm>
#include <optional>

#include "scene/reader.h"
#include "scene_text.h"

namespace carom::bench {

namespace {

class Reducer {
  public:
    Reducer(const Kind& kind, Reduced best, int tries)
        : kind_(kind), best_(std::move(best)), left_(tries) {}

    Reduced run() {
        shorten();
        if (!best_.trial.other.empty()) return best_;
        while (drop_one()) {
        }
        drop_spins();
        shorten();
        return best_;
    }

  private:
    static std::optional<Scene> read(const std::string& text) {
        return read_scene(text, "scene.yaml").scene;
    }

    /// Keeps the changed trial if it fails alike.
    bool keep(Trial trial) {
        if (left_-- <= 0) return false;
        Verdict v = run_guarded([&](Watch& watch) { return kind_.judge(trial, watch); });
        if (v.symptom != best_.verdict.symptom) return false;
        best_ = {std::move(trial), std::move(v)};
        return true;
    }
    bool keep(const Scene& scene) {
        Trial trial = best_.trial;
        trial.scene = scene_text(scene);
        return keep(std::move(trial));
    }

    /// Ends at the failure, or a little after it.
    void shorten() {
        const double at = best_.verdict.time;
        for (const double after : {1e-6, 0.05, 0.2}) {
            std::optional<Scene> scene = read(best_.trial.scene);
            if (!scene || at + after >= scene->simulation.duration.value_or(0)) return;
            scene->simulation.duration = at + after;
            Trial trial = best_.trial;
            trial.scene = scene_text(*scene);
            if (std::optional<Scene> other = read(trial.other)) {
                other->simulation.duration = at + after;
                trial.other = scene_text(*other);
            }
            if (keep(std::move(trial))) return;
        }
    }

    template <class T>
    bool drop_one_of(std::vector<T> Scene::*list) {
        bool dropped = false;
        std::optional<Scene> scene = read(best_.trial.scene);
        for (std::size_t i = scene ? (*scene.*list).size() : 0; i-- > 0;) {
            Scene smaller = *scene;
            (smaller.*list).erase((smaller.*list).begin() + static_cast<std::ptrdiff_t>(i));
            if (smaller.balls.empty() || !keep(smaller)) continue;
            scene = std::move(smaller);
            dropped = true;
        }
        return dropped;
    }

    bool drop_one() {
        if (left_ <= 0) return false;
        const bool balls = drop_one_of(&Scene::balls);
        const bool surfaces = drop_one_of(&Scene::surfaces);
        const bool pairs = drop_one_of(&Scene::pairs);
        return balls || surfaces || pairs;
    }

    void drop_spins() {
        std::optional<Scene> scene = read(best_.trial.scene);
        for (std::size_t i = 0; scene && i < scene->balls.size(); ++i) {
            if (scene->balls[i].spin.isZero(0)) continue;
            Scene simpler = *scene;
            simpler.balls[i].spin.setZero();
            if (keep(simpler)) scene = std::move(simpler);
        }
    }

    const Kind& kind_;
    Reduced best_;
    int left_;
};

}  // namespace

Reduced reduce(const Kind& kind, const Trial& trial, const Verdict& verdict, int tries) {
    return Reducer(kind, {trial, verdict}, tries).run();
}

}  // namespace carom::bench
