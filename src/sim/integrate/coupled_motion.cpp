#include "sim/integrate/coupled_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/integrate/piece_integrator.h"
#include "sim/law/contact_modes.h"

namespace carom {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The first piece of a slip is no longer than so many of its times: explicit steps are.
constexpr double kFirstPiece = 20;

/// The law of a few balls that lasting contacts link.
class CoupledLaw {
  public:
    static constexpr std::size_t kBalls = kMostLinkedBalls;
    /// Ten times that of one ball: forces from a system of equations are less smooth by their
    /// rounding.
    static constexpr double kStepError = 1e-13;
    static constexpr int kMostEvaluations = 1'000;
    static constexpr double kFitError = kLinkedError;
    static constexpr double kFitSpeedError = kLinkedError;
    using State = LinkedState;
    using Forces = LinkedForces;

    /// What must stay >= 0 at one contact: its push, the room on its feature, its grip.
    struct Gate {
        std::size_t contact = 0;
        LinkedEnd end = LinkedEnd::kNone;
        int of_feature = 0;
    };

    CoupledLaw(const LinkedBalls& system, const LinkedState& start)
        : system_(system), size_(system.smallest_radius()), speed_(speed_of(system, start)) {
        for (std::size_t i = 0; i < system.contact_count; ++i) add_gates(i);
    }

    std::size_t ball_count() const { return system_.ball_count; }
    double size() const { return size_; }
    double speed() const { return speed_; }
    LinkedForces forces(const LinkedState& s) const { return linked_forces(system_, s); }
    const Vec3& acceleration(const LinkedForces& f, std::size_t b) const {
        return f.acceleration[b];
    }
    const Vec3& spin_rate(const LinkedForces& f, std::size_t b) const { return f.spin_rate[b]; }

    int gate_count() const { return gate_count_; }
    const Gate& gate_at(int i) const { return gates_[static_cast<std::size_t>(i)]; }
    double gate(int i, const LinkedState& s, const LinkedForces& f) const {
        const Gate& g = gate_at(i);
        const LinkedContact& c = system_.contacts[g.contact];
        const LinkedContactForces& at = f.contacts[g.contact];
        switch (g.end) {
            case LinkedEnd::kIdleEnds:
                return idle_room(system_, at);
            case LinkedEnd::kParts:
                return at.push - least_push(system_, c, s);
            case LinkedEnd::kGripEnds:
                return grip_left(c, at);
            case LinkedEnd::kSlipGrows: {
                const double drive = at.slip_rate.dot(at.direction) / system_.gravity.norm();
                return std::min(kMostLag - lag_of(at, speed_), drive + kLeastDrive);
            }
            default:
                return c.feature.gates[static_cast<std::size_t>(g.of_feature)].room(
                    s[static_cast<std::size_t>(c.ball)].x);
        }
    }
    bool skip_start(int) const { return false; }

  private:
    void add_gates(std::size_t i) {
        const LinkedContact& c = system_.contacts[i];
        if (!c.presses) return add(i, LinkedEnd::kIdleEnds);
        add(i, LinkedEnd::kParts);
        if (c.mode == CurvedMode::kRolling) add(i, LinkedEnd::kGripEnds);
        if (c.mode == CurvedMode::kIncipient) add(i, LinkedEnd::kSlipGrows);
        for (int k = 0; c.other < 0 && k < c.feature.gate_count; ++k)
            add(i, LinkedEnd::kFeature, k);
    }
    void add(std::size_t contact, LinkedEnd end, int of_feature = 0) {
        gates_[static_cast<std::size_t>(gate_count_++)] = {contact, end, of_feature};
    }

    const LinkedBalls& system_;
    double size_, speed_;
    std::array<Gate, kMostLinkedContacts*(2 + kMostGates)> gates_;
    int gate_count_ = 0;
};

/// The longest piece that its laws bear, before its error is known.
double longest_piece(const LinkedBalls& system, const LinkedState& start, const LinkedForces& f) {
    double h = kInfinity;
    for (std::size_t i = 0; i < system.contact_count; ++i) {
        const LinkedContact& c = system.contacts[i];
        const LinkedContactForces& at = f.contacts[i];
        if (!c.presses) continue;
        h = std::min(h, kLongestTurn * std::sqrt(c.feature.distance / system.gravity.norm()));
        if (const double turning = at.normal_rate.norm(); turning > 0)
            h = std::min(h, kLongestTurn / turning);
        if (c.mode != CurvedMode::kSliding) continue;
        const double slip = at.slip.norm();
        const double slowing = -at.slip.dot(at.slip_rate) / slip;
        if (slowing > 0) h = std::min(h, kSlipPart * slip / slowing);
    }
    for (std::size_t b = 0; b < system.ball_count; ++b)
        h = std::min(h, longest_turn(start[b].w, f.spin_rate[b]));
    return h;
}

/// How fast the direction of a slip answers to what turns it, s: the smaller the slip, the stiffer.
double slip_time(const LinkedBalls& system, const LinkedForces& f) {
    double shortest = kInfinity;
    for (std::size_t i = 0; i < system.contact_count; ++i) {
        const LinkedContact& c = system.contacts[i];
        if (!c.presses || c.mode != CurvedMode::kSliding) continue;
        const double hold = f.contacts[i].friction.norm() * system.gravity.norm();
        if (hold > 0)
            shortest = std::min(shortest, f.contacts[i].slip.norm() * system.weight_at(c) / hold);
    }
    return shortest;
}

}  // namespace

LinkedPiece next_piece(const LinkedBalls& system, const LinkedState& state, double now,
                       double guess) {
    const CoupledLaw law(system, state);
    const LinkedForces forces = law.forces(state);
    const double longest = longest_piece(system, state, forces);
    const double first = std::min(0.25 * longest, kFirstPiece * slip_time(system, forces));
    const IntegratedPiece<CoupledLaw> next =
        PieceIntegrator(law, state).next(now, std::min(longest, guess > 0 ? guess : first));
    LinkedPiece result;
    result.seconds = next.seconds;
    result.next_seconds = next.next_seconds;
    if (next.gate >= 0) {
        result.end = law.gate_at(next.gate).end;
        result.contact = law.gate_at(next.gate).contact;
    }
    for (std::size_t b = 0; next.seconds > 0 && b < system.ball_count; ++b) {
        const Piece& p = next.pieces[b];
        result.balls[b] = {p.acceleration, p.spin_rate, *p.curve};
    }
    return result;
}

}  // namespace carom
