#include "sim/integrate/coupled_motion.h"

#include <algorithm>
#include <cmath>

#include "core/infinity.h"
#include "sim/integrate/piece_integrator.h"
#include "sim/law/contact_modes.h"

namespace carom {

namespace {

/// The first piece of a slip is no longer than so many of its times: explicit steps are.
constexpr double kFirstPiece = 20;

/// The law of a few balls that lasting contacts link.
class CoupledLaw {
  public:
    static constexpr std::size_t kBalls = kMostCoupledBalls;
    /// Ten times that of one ball: forces from a system of equations are less smooth by their
    /// rounding.
    static constexpr double kStepError = 1e-13;
    static constexpr int kMostEvaluations = 1'000;
    static constexpr double kFitError = kCoupledError;
    static constexpr double kFitSpeedError = kCoupledError;
    using State = CoupledState;
    using Forces = CoupledForces;

    /// What must stay >= 0 at one contact: its push, the room on its feature, its grip.
    struct Guard {
        std::size_t contact = 0;
        CoupledEnd end = CoupledEnd::kNone;
        int border = 0;
    };

    CoupledLaw(const CoupledContacts& system, const CoupledState& start)
        : system_(system), size_(system.smallest_radius()), speed_(speed_of(system, start)) {
        for (std::size_t i = 0; i < system.contact_count; ++i) add_guards(i);
    }

    std::size_t ball_count() const { return system_.ball_count; }
    double size() const { return size_; }
    double speed() const { return speed_; }
    CoupledForces forces(const CoupledState& s) const { return coupled_forces(system_, s); }
    const Vec3& acceleration(const CoupledForces& f, std::size_t b) const {
        return f.acceleration[b];
    }
    const Vec3& spin_rate(const CoupledForces& f, std::size_t b) const { return f.spin_rate[b]; }
    double energy_error(const CoupledState& a, const CoupledState& b) const {
        double error = 0, in_play = 0;
        for (std::size_t i = 0; i < system_.ball_count; ++i) {
            const CoupledBall& ball = system_.balls[i];
            error += ball.mass * energy_difference(a[i], b[i], ball.radius, ball.inertia_factor,
                                                   system_.pull(i));
            in_play +=
                ball.mass * energy_in_play(b[i], ball.radius, ball.inertia_factor, system_.pull(i));
        }
        return error / in_play;
    }

    int guard_count() const { return guard_count_; }
    const Guard& guard_at(int i) const { return guards_[static_cast<std::size_t>(i)]; }
    double guard(int i, const CoupledState& s, const CoupledForces& f) const {
        const Guard& g = guard_at(i);
        const CoupledContact& c = system_.contacts[g.contact];
        const CoupledContactForces& at = f.contacts[g.contact];
        switch (g.end) {
            case CoupledEnd::kIdleEnds:
                return idle_margin(system_, at);
            case CoupledEnd::kParts:
                return at.push - lift_off_threshold(system_, c, s);
            case CoupledEnd::kGripEnds:
                return grip_left(c, at);
            case CoupledEnd::kSlipGrows: {
                const double drive = at.slip_rate.dot(at.direction) / system_.gravity.norm();
                return std::min(kMostLag - lag_of(at, speed_), drive + kLeastDrive);
            }
            default:
                return c.feature.borders[static_cast<std::size_t>(g.border)].margin(
                    s[static_cast<std::size_t>(c.ball)].x);
        }
    }
    bool skip_start(int) const { return false; }

  private:
    void add_guards(std::size_t i) {
        const CoupledContact& c = system_.contacts[i];
        if (!c.presses) return add(i, CoupledEnd::kIdleEnds);
        add(i, CoupledEnd::kParts);
        if (c.mode == ContactMode::kRolling) add(i, CoupledEnd::kGripEnds);
        if (c.mode == ContactMode::kIncipient) add(i, CoupledEnd::kSlipGrows);
        for (int k = 0; c.other < 0 && k < c.feature.border_count; ++k)
            add(i, CoupledEnd::kFeature, k);
    }
    void add(std::size_t contact, CoupledEnd end, int border = 0) {
        guards_[static_cast<std::size_t>(guard_count_++)] = {contact, end, border};
    }

    const CoupledContacts& system_;
    double size_, speed_;
    std::array<Guard, kMostCoupledContacts*(2 + kMostBorders)> guards_;
    int guard_count_ = 0;
};

/// The longest piece that its laws bear, before its error is known.
double longest_piece(const CoupledContacts& system, const CoupledState& start,
                     const CoupledForces& f) {
    double h = kInfinity;
    for (std::size_t i = 0; i < system.contact_count; ++i) {
        const CoupledContact& c = system.contacts[i];
        const CoupledContactForces& at = f.contacts[i];
        if (!c.presses) continue;
        h = std::min(h, kLongestTurn * std::sqrt(c.feature.distance / system.gravity.norm()));
        if (const double turning = at.normal_rate.norm(); turning > 0)
            h = std::min(h, kLongestTurn / turning);
        if (c.mode != ContactMode::kSliding) continue;
        const double slip = at.slip.norm();
        const double slowing = -at.slip.dot(at.slip_rate) / slip;
        if (slowing > 0) h = std::min(h, kSlipPart * slip / slowing);
    }
    for (std::size_t b = 0; b < system.ball_count; ++b)
        h = std::min(h, longest_turn(start[b].w, f.spin_rate[b]));
    return h;
}

/// How fast the direction of a slip answers to what turns it, s: the smaller the slip, the stiffer.
double slip_time(const CoupledContacts& system, const CoupledForces& f) {
    double shortest = kInfinity;
    for (std::size_t i = 0; i < system.contact_count; ++i) {
        const CoupledContact& c = system.contacts[i];
        if (!c.presses || c.mode != ContactMode::kSliding) continue;
        const double hold = f.contacts[i].friction.norm() * system.gravity.norm();
        if (hold > 0)
            shortest = std::min(shortest, f.contacts[i].slip.norm() * system.weight_at(c) / hold);
    }
    return shortest;
}

}  // namespace

CoupledPiece next_piece(const CoupledContacts& system, const CoupledState& state, double now,
                        double guess) {
    const CoupledLaw law(system, state);
    const CoupledForces forces = law.forces(state);
    const double longest = longest_piece(system, state, forces);
    const double first = std::min(0.25 * longest, kFirstPiece * slip_time(system, forces));
    const IntegratedPiece<CoupledLaw> next =
        PieceIntegrator(law, state).next(now, std::min(longest, guess > 0 ? guess : first));
    CoupledPiece result;
    result.seconds = next.seconds;
    result.next_seconds = next.next_seconds;
    if (next.guard >= 0) {
        result.end = law.guard_at(next.guard).end;
        result.contact = law.guard_at(next.guard).contact;
    }
    for (std::size_t b = 0; next.seconds > 0 && b < system.ball_count; ++b) {
        const Piece& p = next.pieces[b];
        result.balls[b] = {p.acceleration, p.spin_rate, *p.curve};
    }
    return result;
}

}  // namespace carom
