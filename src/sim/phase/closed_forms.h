// Motions with a closed form: flight, and a lasting contact with a flat surface.
#pragma once

#include <vector>

#include "sim/phase/contact_rules.h"
#include "sim/phase/run_log.h"

namespace carom {

/// How a lasting contact begins.
struct Onset {
    double bounce_time_left = 0;  ///< s: of its bouncing series, whose end states the contact
    bool at_start = false;        ///< it exists at time 0: its first kind is no news
};

class ClosedForms {
  public:
    /// `end` [s] of the motion.
    ClosedForms(ExactWorld& world, const ContactRules& rules, RunLog& log, double end)
        : world_(world), rules_(rules), log_(log), end_(end) {}

    void begin_flight(int ball, double now, const Velocities& velocities);
    /// The next piece of a flight through air.
    void fly_on(int ball, double now);
    /// Whether a lasting contact has a closed form: on a flat surface, slip that does not turn.
    bool can_hold(int ball, double now, const Contact& contact, const Velocities& velocities) const;
    /// Only where can_hold().
    void begin_flat_contact(int ball, double now, const Contact& contact,
                            const Velocities& velocities, const Onset& onset);
    /// The velocities with which a ball goes on in a contact whose last bounces are summed.
    Velocities landed(int ball, double now, const Contact& contact, const Velocities& velocities,
                      double separation) const;
    /// The ball is held by a surface, kFlat or kIntegrated, with this normal and kind of contact. A
    /// change of kind is an event; that of a contact that begins waits for the end of its bounces.
    void hold(int ball, double now, Phase phase, int surface, const Vec3& normal, EventKind kind,
              const Onset& onset);

  private:
    void fly_on(int ball, double now, const BallState& at);

    ExactWorld& world_;
    const ContactRules& rules_;
    RunLog& log_;
    double end_;
    /// Of a ball in air: a good length for its next piece [s], and how far [m] and fast [m/s] it
    /// goes.
    struct InAir {
        double next_seconds = 0, way = 0, speed = 0;
    };
    std::vector<InAir> in_air_;  ///< per ball; empty where none flies in air
};

}  // namespace carom
