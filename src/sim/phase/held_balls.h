// One ball on one lasting contact: in closed form where there is one, integrated piece by piece
// where there is none.
#pragma once

#include <map>
#include <optional>

#include "sim/integrate/single_phase.h"
#include "sim/phase/closed_forms.h"

namespace carom {

class HeldBalls {
  public:
    HeldBalls(ExactWorld& world, const ContactRules& rules, InstantNotes& notes, RunLog& log,
              ClosedForms& forms)
        : world_(world), rules_(rules), notes_(notes), log_(log), forms_(forms) {}

    /// The velocities of a ball that nothing else gets on with: it has to be stepped as an island.
    /// Empty where the ball goes on by itself.
    using Handover = std::optional<Velocities>;

    /// A single lasting contact with a surface goes on.
    [[nodiscard]] Handover begin(int ball, double now, const Contact& contact,
                                 const Velocities& velocities, const Onset& onset);
    /// What was due for a ball that a surface holds: an event, or the end of a piece or phase.
    [[nodiscard]] Handover end_phase(int ball, double now);
    /// The last resort where something cannot be integrated, or has no end in time: for a while the
    /// ball is stepped, each time for longer.
    Velocities give_up(int ball, double now);
    bool is_given_up(int ball, double now) const;
    /// On its surface, and moving along it, to rounding: before it is met by something else.
    void put_on_surface(int ball, double now);

    /// The contact of an impact that has come, `seconds` after the start of the ball's piece. On a
    /// surface the ball takes what rounding left of the gap and of the time: late in a bouncing
    /// series a hop is short against the time's last digit, and g times that digit is much against
    /// its speed.
    Contact meet(int ball, const Partner& partner, double seconds, double now);

  private:
    Handover begin_integrated(int ball, double now, const Contact& contact,
                              const Velocities& velocities, const Onset& onset);
    Handover begin_integrated_on(int ball, double now, const Contact& contact,
                                 const SingleContact& feature, const Velocities& velocities,
                                 const Onset& onset);
    std::optional<Handover> go_over_seam(int ball, double now, const Velocities& velocities);
    void begin_rest(int ball, double now, const SingleContactForces& forces);
    SingleContactForces choose_mode(IntegratedPhase& phase, double tolerance) const;
    Handover lift_off(int ball, double now, const Partner& surface, const Vec3& normal);
    Handover advance(int ball, double now);
    Handover end_integrated(int ball, double now);
    Velocities step_instead(int ball, double now);
    void put_at(int ball, double now, const Vec3& x);

    ExactWorld& world_;
    const ContactRules& rules_;
    InstantNotes& notes_;
    RunLog& log_;
    ClosedForms& forms_;
    std::map<int, IntegratedPhase> integrated_;  ///< by ball
};

}  // namespace carom
