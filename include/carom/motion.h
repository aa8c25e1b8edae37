// The motion of a scene as a function of time.
#pragma once

#include <carom/scene.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

CAROM_NAMESPACE_BEGIN

/// Of one ball at one instant.
struct State {
    Vec3 position{};                                ///< of the centre, m
    std::array<double, 4> orientation{1, 0, 0, 0};  ///< w, x, y, z: world from ball
    Vec3 velocity{};                                ///< m/s
    Vec3 spin{};                                    ///< rad/s, world axes
};

enum class EventKind { impact, slide, roll, rest, leave };
CAROM_API const char* name(EventKind kind);

/// A row of EVENTS.csv (docs/output.md).
struct Event {
    double time = 0;  ///< s
    int ball = -1;    ///< index into balls(); of two balls the one that the scene names first
    int other = -1;   ///< index into balls(), or into surfaces() where `other_is_surface`
    bool other_is_surface = true;
    EventKind kind = EventKind::impact;
    Vec3 point{};                                     ///< of the contact, m
    Vec3 normal{};                                    ///< unit, towards `ball`
    double approach_speed = 0, separation_speed = 0;  ///< m/s; impacts only, as are all below
    double restitution = 0;                           ///< of the pair
    double impulse = 0, tangential_impulse = 0;       ///< N s
};

/// The top of the gap under a ball between two impacts.
struct Peak {
    double time = 0;    ///< s
    double height = 0;  ///< m
};

/// Cheap to copy: copies share one, which never changes. Safe from several threads at once.
class CAROM_API Motion {
  public:
    double duration() const;  ///< s
    std::vector<std::string> balls() const;
    std::vector<std::string> surfaces() const;
    /// Exact at any instant, not only at frames. Throws Error for one outside 0 ... duration,
    /// or for a ball that is not there.
    State state(std::size_t ball, double time) const;
    /// Of all balls at all times: times.size() * balls().size() states, by time, then by ball.
    std::vector<State> states(const std::vector<double>& times) const;
    std::vector<Event> events() const;
    std::vector<Peak> peaks(std::size_t ball) const;
    /// Equal for equal motions: what --stats calls motion_hash.
    std::uint64_t hash() const;

    struct Impl;
    explicit Motion(std::shared_ptr<const Impl> impl);
    const Impl& impl() const { return *impl_; }

  private:
    std::shared_ptr<const Impl> impl_;
};

/// What goes on beside long work; each may be left out.
struct Control {
    std::stop_token stop{};                       ///< a request ends the work with Stopped
    std::function<void(double done)> progress{};  ///< s of motion simulated, or frames written
};

/// Throws Error where the simulation fails.
CAROM_API Motion simulate(const Scene& scene, const Control& control = {});

CAROM_NAMESPACE_END
