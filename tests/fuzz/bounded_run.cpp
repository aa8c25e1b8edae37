#include "bounded_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <thread>

#include "core/failure.h"
#include "scene/reader.h"
#include "sim/simulate.h"
#include "target.h"

namespace carom::fuzz {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kDuration_s = 0.5;
constexpr std::size_t kMostBalls = 40, kMostSurfaces = 60;
constexpr std::chrono::milliseconds kWork{1000};
/// The promise is half a second; the rest is for sanitizers and a busy machine.
constexpr std::chrono::milliseconds kGrace{5000};

/// Asks to stop when the time is up, unless the work has ended.
class Watch {
  public:
    Watch() : thread_([this] { wait(); }) {}
    ~Watch() {
        {
            const std::lock_guard lock(mutex_);
            done_ = true;
        }
        changed_.notify_all();
        thread_.join();
    }
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;
    std::stop_token token() const { return stop_.get_token(); }

  private:
    void wait() {
        std::unique_lock lock(mutex_);
        if (changed_.wait_for(lock, kWork, [this] { return done_; })) return;
        stop_.request_stop();
    }

    std::stop_source stop_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool done_ = false;
    std::thread thread_;
};

void check_states(const Scene& scene, const Motion& motion) {
    if (motion.balls.size() != scene.balls.size()) broken_promise("balls without a motion");
    for (const Trajectory& ball : motion.balls)
        for (const double part : {0.0, 0.3, 1.0}) {
            const BallState state = ball.at(part * motion.duration);
            if (!state.position.allFinite() || !state.velocity.allFinite())
                broken_promise("a state that is not finite");
        }
}

}  // namespace

std::optional<Scene> small_scene(std::string_view text) {
    std::optional<Scene> scene = read_scene(text, "fuzz.yaml").scene;
    if (!scene || scene->balls.size() > kMostBalls || scene->surfaces.size() > kMostSurfaces)
        return std::nullopt;
    scene->simulation.duration =
        std::min(scene->simulation.duration.value_or(kDuration_s), kDuration_s);
    scene->film.width_px = 64;
    scene->film.height_px = 36;
    return scene;
}

std::optional<SimulationResult> bounded_motion(const Scene& scene) {
    const Clock::time_point start = Clock::now();
    std::optional<SimulationResult> result;
    try {
        const Watch watch;
        result = simulate(scene, watch.token());
    } catch (const Failure&) {
    }
    if (Clock::now() - start > kWork + kGrace) broken_promise("did not stop when asked to");
    if (result) check_states(scene, result->motion);
    return result;
}

}  // namespace carom::fuzz
