#include "report/growing_motion.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <system_error>
#include <utility>

#include "media/thread_clock.h"
#include "render/marks/labels.h"
#include "scene/film_clock.h"
#include "sim/record/kept_limit.h"

namespace carom {

namespace {

/// How often pieces are handed over: a film shows some hundred frames a second at most.
constexpr std::chrono::milliseconds kBetweenPieces{2};
constexpr std::chrono::milliseconds kBetweenSigns{100};

/// Pieces that wait to be used, 5 MB: what is simulated in some 10 ms, five times what comes at
/// once.
constexpr std::size_t kMostWaiting = 1 << 14;

constexpr double kEnd = std::numeric_limits<double>::infinity();

std::string why_overlay(const Overlay& overlay) {
    if (overlay.ruler) return "the ruler stands beside the whole motion";
    if (overlay.trail) return "the corners of trails are spread over the whole motion";
    if (overlay.peaks) return "peaks keep clear of those that come later";
    if (overlay.plot) return "the axes of the plot reach over the whole motion";
    if (overlay.velocity && !overlay.velocity->scale_s)
        return "the arrows' scale follows from the greatest speed of all (overlay.velocity.scale "
               "sets it)";
    return "";
}

}  // namespace

std::string why_whole_motion(const Scene& scene, bool has_second) {
    if (!scene.simulation.duration) return "the film is as long as the motion (duration: rest)";
    if (has_second) return "two runs are shown";
    if (!scene.camera) return "the camera is framed around the whole motion (camera sets it)";
    if (scene.test) return "the picture has the verdict of a test";
    if (const std::string why = why_overlay(scene.overlay); !why.empty()) return why;
    return why_known_at_end(scene);
}

MotionSpan needed_for_picture(const Scene& scene, double t) {
    const Film& film = scene.film;
    const double beside_s = (scene.overlay.labels ? kLabelReach_s : 0) + 1 / film.fps.per_second();
    const double film_s = film_time(film, t);
    const double smooth_s = scene.camera ? scene.camera->smooth_s : 0;
    const double from = film_s > beside_s ? motion_time(film, film_s - beside_s) - smooth_s : 0;
    return {std::max(from, 0.0), motion_time(film, film_s + beside_s) + smooth_s};
}

GrowingMotion::GrowingMotion(const Scene& scene, Keep keep, const std::stop_token& stop)
    : scene_(scene), keep_(keep), outer_stop_(stop, [this] { stop_.request_stop(); }) {
    motion_.duration = *scene.simulation.duration;
    for (const Ball& ball : scene.balls) motion_.ball_names.push_back(ball.name);
    for (const Surface& surface : scene.surfaces) motion_.surface_names.push_back(surface.name);
    motion_.balls.resize(scene.balls.size());
    try {
        thread_ = std::thread([this] { simulate(); });
    } catch (const std::system_error&) {
        bounded_ = false;  // nobody would make room
        simulate();
    }
}

GrowingMotion::~GrowingMotion() {
    stop_.request_stop();
    if (thread_.joinable()) thread_.join();
}

// ---- The simulation's thread

void GrowingMotion::simulate() {
    const double begin = calling_thread_cpu_s();
    std::chrono::steady_clock::time_point handed_over;
    SimulationResult result;
    std::exception_ptr failure;
    const PieceTap tap = [&](MotionLog& pieces, std::vector<Event>& events, double now) {
        const auto time = std::chrono::steady_clock::now();
        if (now < kEnd && time - handed_over < kBetweenPieces) return;
        handed_over = time;
        take(pieces, events, now);
    };
    try {
        result = simulate_piecewise(scene_, stop_.get_token(), tap);
    } catch (...) {
        failure = std::current_exception();
    }
    {
        const std::lock_guard lock(mutex_);
        result_ = std::move(result);
        failure_ = failure;
        ended_ = true;
        cpu_s_ = calling_thread_cpu_s() - begin;
    }
    news_.notify_all();
}

void GrowingMotion::take(MotionLog& pieces, std::vector<Event>& events, double now) {
    const auto end =
        std::find_if(events.begin(), events.end(), [now](const Event& e) { return e.time >= now; });
    {
        std::unique_lock lock(mutex_);
        if (pieces.pieces() > 0) {
            waiting_pieces_ += pieces.pieces();
            pieces_.push_back(std::exchange(pieces, MotionLog(pieces.balls())));
        }
        if (keep_ == Keep::kAll) events_.insert(events_.end(), events.begin(), end);
        until_ = now;
        news_.notify_all();
        // After a request it goes on, and finds it by itself.
        room_.wait(lock, stop_.get_token(), [this] { return !is_full(); });
    }
    events.erase(events.begin(), end);
}

bool GrowingMotion::is_full() const { return bounded_ && waiting_pieces_ > kMostWaiting; }

// ---- The thread that uses the motion

/// Waits until it is enough, and puts what comes into motion_.
void GrowingMotion::fetch(const std::function<bool()>& is_enough,
                          const std::function<void()>& waiting) {
    auto next_sign = std::chrono::steady_clock::now() + kBetweenSigns;
    for (bool done = false; !done;) {
        if (std::chrono::steady_clock::now() >= next_sign) {
            if (waiting) waiting();
            next_sign = std::chrono::steady_clock::now() + kBetweenSigns;
        }
        std::vector<MotionLog> pieces;
        {
            std::unique_lock lock(mutex_);
            const auto has_news = [&] { return ended_ || is_enough() || is_full(); };
            if (!news_.wait_until(lock, next_sign, has_news)) continue;
            if (failure_) std::rethrow_exception(failure_);
            done = ended_ || is_enough();
            pieces.swap(pieces_);
            waiting_pieces_ = 0;
            known_until_ = until_;
            motion_.events.insert(motion_.events.end(), events_.begin(), events_.end());
            events_.clear();
        }
        room_.notify_all();
        put_in(pieces);
    }
}

void GrowingMotion::put_in(std::vector<MotionLog>& pieces) {
    for (MotionLog& log : pieces) {
        kept_ += log.pieces();
        log.move_into(motion_.balls);
    }
    if (keep_ == Keep::kNeeded) {
        for (Trajectory& ball : motion_.balls) ball.let_go_before(needed_from_);
    } else {
        require_room(kept_ + motion_.events.size(), known_until_, motion_.duration);
    }
}

void GrowingMotion::wait_for(const MotionSpan& span, const std::function<void()>& waiting) {
    needed_from_ = span.from;
    if (span.to < known_until_) return;
    fetch([&] { return span.to < until_; }, waiting);
}

SimulationResult GrowingMotion::finish() {
    needed_from_ = motion_.duration;
    fetch([] { return false; }, {});
    if (thread_.joinable()) thread_.join();
    if (keep_ == Keep::kAll)
        complete(scene_, std::move(motion_.balls), std::move(motion_.events), result_);
    return std::move(result_);
}

}  // namespace carom
