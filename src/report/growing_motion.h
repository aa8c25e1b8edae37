// A motion that is drawn, or written, while it is computed.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "motion/motion_log.h"
#include "scene/scene.h"
#include "sim/simulate.h"

namespace carom {

/// Why a film of this scene cannot begin before its motion is known to the end; "" where it can.
/// `has_second` says whether a second run is shown with it.
std::string why_whole_motion(const Scene& scene, bool has_second);

/// A part of the motion, s.
struct MotionSpan {
    double from = 0, to = 0;
};

/// What must be known of the motion for the picture of the instant t [s]: labels look
/// kLabelReach_s of film to either side, the shutter half a frame, a camera that follows smoothly
/// half its time.
MotionSpan needed_for_picture(const Scene& scene, double t);

/// Simulates on a thread of its own. All else is of one thread, the one that uses the motion; what
/// it has been given does not change under it.
///
/// Memory: with Keep::kAll that of the motion; it fails as simulate() does where that is too much.
/// With Keep::kNeeded a bounded number of pieces that wait, at which the simulation waits too, and
/// those of the span that is needed. Where the system gives no thread the constructor simulates and
/// keeps all.
class GrowingMotion {
  public:
    enum class Keep { kAll, kNeeded };

    /// For a scene of a given duration for which why_known_at_end() says nothing; it must outlive
    /// this.
    GrowingMotion(const Scene& scene, Keep keep, const std::stop_token& stop);
    ~GrowingMotion();  ///< stops the simulation
    GrowingMotion(const GrowingMotion&) = delete;
    GrowingMotion& operator=(const GrowingMotion&) = delete;

    /// Its duration and names are there from the start, its pieces as wait_for() says, its events
    /// and peaks never.
    const Motion& motion() const { return motion_; }
    /// Returns when the motion is known in this span; calls `waiting` ten times a second until
    /// then. What is before it is not needed any more. Throws what the simulation threw.
    void wait_for(const MotionSpan& span, const std::function<void()>& waiting = {});
    /// Up to which instant [s] it was known at the last wait_for(); infinity: to its end.
    double known_until() const { return known_until_; }
    bool is_whole() const { return known_until_ > motion_.duration; }
    /// Waits for the end: with Keep::kAll simulate()'s result, else its report alone. motion() is
    /// empty afterwards.
    SimulationResult finish();
    double cpu_s() const { return cpu_s_; }  ///< of the simulation, after finish()

  private:
    void simulate();
    void take(MotionLog& pieces, std::vector<Event>& events, double now);
    void fetch(const std::function<bool()>& is_enough, const std::function<void()>& waiting);
    void put_in(std::vector<MotionLog>& pieces);
    bool is_full() const;

    const Scene& scene_;
    const Keep keep_;
    Motion motion_;
    double known_until_ = 0;  ///< as the using thread knows it
    double needed_from_ = 0;
    std::size_t kept_ = 0;  ///< pieces and events

    mutable std::mutex mutex_;
    std::condition_variable news_;
    std::condition_variable_any room_;
    std::vector<MotionLog> pieces_;  ///< not yet in motion_
    std::vector<Event> events_;      ///< likewise
    std::size_t waiting_pieces_ = 0;
    double until_ = 0;  ///< all pieces before it have been handed over
    bool bounded_ = true;
    bool ended_ = false;
    std::exception_ptr failure_;
    SimulationResult result_;
    double cpu_s_ = 0;

    std::stop_source stop_;
    std::stop_callback<std::function<void()>> outer_stop_;
    std::thread thread_;  ///< last: it uses all of the above
};

}  // namespace carom
