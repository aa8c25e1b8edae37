#include "sim/integrate/single_motion.h"

#include <cmath>
#include <optional>

#include "sim/integrate/piece_integrator.h"

namespace carom {

namespace {

/// A slip of this fraction of the ball's speeds is none.
constexpr double kNoSlip = 1e-12;

/// An incipient slip follows what drives it up to this fraction of the speeds. Its own direction
/// lags by (turning rate) (slip) / (drive), which leaves 1e-11 of a speed.
constexpr double kSmallSlip = 1e-7;

/// A slip that friction ends within this time [s] may end at once: gravity does no more than 1e-8
/// m/s meanwhile. Under large friction a slip that turns is stiff towards its end.
constexpr double kSudden = 1e-9;

bool is_resisted_roll(const SingleContact& c, ContactMode mode) {
    return c.rolling > 0 && mode == ContactMode::kRolling;
}

/// The law of one ball on one feature.
class SingleLaw {
  public:
    static constexpr std::size_t kBalls = 1;
    static constexpr double kStepError = 1e-14;
    static constexpr int kMostEvaluations = 20'000;
    static constexpr double kFitError = kCurveError;
    static constexpr double kFitSpeedError = kCurveSpeedError;
    using State = std::array<ContactState, 1>;
    using Forces = SingleContactForces;

    /// `settled`: guards that are negative at the start end nothing there.
    SingleLaw(const SingleContact& contact, ContactMode mode, const ContactState& start,
              bool settled)
        : contact_(contact),
          mode_(mode),
          settled_(settled),
          speed_(start.v.norm() + contact.radius * start.w.norm() +
                 std::sqrt(contact.gravity.norm() * contact.radius)) {
        const auto watch = [this](SingleEnd end) { own_[own_count_++] = end; };
        if (mode == ContactMode::kRolling) watch(SingleEnd::kGripEnds);
        if (mode == ContactMode::kIncipient) watch(SingleEnd::kSlipGrows);
        if (mode == ContactMode::kIncipient) watch(SingleEnd::kSlipEnds);
        if (is_resisted_roll(contact, mode) && contact.roll_begins) watch(SingleEnd::kRollGrows);
        if (contact.pivoting > 0)
            watch(contact.pivots == 0 ? SingleEnd::kPivotSlips : SingleEnd::kPivotEnds);
    }

    std::size_t ball_count() const { return 1; }
    double size() const { return contact_.radius; }
    double speed() const { return speed_; }
    SingleContactForces forces(const State& s) const {
        return single_contact_forces(contact_, mode_, s[0]);
    }
    const Vec3& acceleration(const SingleContactForces& f, std::size_t) const {
        return f.acceleration;
    }
    const Vec3& spin_rate(const SingleContactForces& f, std::size_t) const { return f.spin_rate; }
    double energy_error(const State& a, const State& b) const {
        const double k = contact_.inertia_factor, radius = contact_.radius;
        return energy_difference(a[0], b[0], radius, k, contact_.gravity) /
               energy_in_play(b[0], radius, k, contact_.gravity);
    }

    int guard_count() const { return 1 + contact_.border_count + static_cast<int>(own_count_); }
    SingleEnd end(int i) const {
        if (i == 0) return SingleEnd::kLiftOff;
        if (i <= contact_.border_count) return SingleEnd::kFeature;
        return own_[static_cast<std::size_t>(i - contact_.border_count - 1)];
    }
    double guard(int i, const State& s, const SingleContactForces& f) const {
        switch (end(i)) {
            case SingleEnd::kLiftOff:
                return f.push - lift_off_threshold(contact_, s[0].x);
            case SingleEnd::kFeature:
                return contact_.borders[static_cast<std::size_t>(i - 1)].margin(s[0].x);
            case SingleEnd::kGripEnds:
                return grip_left(contact_, f);
            case SingleEnd::kSlipGrows:
                return kSmallSlip * speed_ - f.slip.norm();
            case SingleEnd::kRollGrows:
                return kSmallSlip * speed_ - s[0].v.norm();
            case SingleEnd::kPivotEnds:
                return contact_.pivots * s[0].w.dot(f.normal);
            case SingleEnd::kPivotSlips:
                return pivot_hold_left(contact_, f, s[0]);
            default:
                return f.slip.dot(f.drive);  // the slip goes back to 0
        }
    }
    bool skip_start(int i) const {
        return settled_ || end(i) == SingleEnd::kSlipEnds || end(i) == SingleEnd::kPivotEnds;
    }

  private:
    const SingleContact& contact_;
    ContactMode mode_;
    bool settled_;
    double speed_;
    std::array<SingleEnd, 4> own_{};  ///< what ends the mode, and what resistance does
    std::size_t own_count_ = 0;
};

/// How fast friction and what drives it change the slip, along it [m/s^2].
double slowing(const SingleContact& c, const SingleContactForces& f) {
    return -f.slip.dot(f.drive + (1 + 1 / c.inertia_factor) * f.friction);
}

/// The longest piece that its laws bear, before its error is known.
double longest_piece(const SingleContact& c, ContactMode mode, const ContactState& s,
                     const SingleContactForces& f) {
    double h = kLongestTurn * std::sqrt(c.distance / c.gravity.norm());
    if (const double turning = f.normal_rate.norm(); turning > 0)
        h = std::min(h, kLongestTurn / turning);
    h = std::min(h, longest_turn(s.w, f.spin_rate));
    if (is_resisted_roll(c, mode) && !c.roll_begins) {
        // As a slip: at its end the direction of the roll turns ever faster.
        const double speed = s.v.norm(), slows = -s.v.dot(f.acceleration) / speed;
        if (slows > 0) h = std::min(h, kSlipPart * speed / slows);
    }
    if (mode != ContactMode::kSliding) return h;
    const double slip = f.slip.norm(), slows = slowing(c, f) / slip;
    return slows > 0 ? std::min(h, kSlipPart * slip / slows) : h;
}

/// The state after the impulse of friction that ends the slip; none where that takes longer.
std::optional<ContactState> sudden_grip(const SingleContact& c, ContactMode mode,
                                        const ContactState& start, const SingleContactForces& f) {
    const double k = c.inertia_factor;
    if (mode != ContactMode::kSliding || !(f.push > 0)) return std::nullopt;
    if (f.slip.norm() > kSudden * c.friction * f.push * (1 + 1 / k)) return std::nullopt;
    ContactState state = start;
    end_slip(c, state);
    return state;
}

}  // namespace

ContactState integrate(const SingleContact& contact, ContactMode mode, const ContactState& state,
                       double seconds) {
    const SingleLaw law(contact, mode, state, false);
    const SingleLaw::State start = {state};
    const ContactOde<SingleLaw> ode(law, start);
    ContactOde<SingleLaw>::Numbers y = ode.first();
    ode.advance(y, seconds);
    return ode.state(y)[0];
}

SinglePiece next_piece(const SingleContact& contact, ContactMode mode, const ContactState& state,
                       double now, double guess, bool settled) {
    const SingleLaw law(contact, mode, state, settled);
    const SingleContactForces forces = law.forces({state});
    SinglePiece result;
    result.end_state = state;
    if (mode == ContactMode::kSliding && forces.slip.norm() <= kNoSlip * law.speed() &&
        slowing(contact, forces) >= 0) {
        result.end = SingleEnd::kSlipEnds;
        return result;
    }
    if (is_resisted_roll(contact, mode) && !contact.roll_begins &&
        state.v.norm() <= kNoSlip * law.speed()) {
        result.end = SingleEnd::kRollEnds;
        return result;
    }
    const double longest = longest_piece(contact, mode, state, forces);
    const SingleLaw::State start = {state};
    const IntegratedPiece<SingleLaw> next =
        PieceIntegrator(law, start)
            .next(now, std::min(longest, guess > 0 ? guess : 0.25 * longest));
    if (next.given_up) {
        const auto gripped = sudden_grip(contact, mode, state, forces);
        result.end = gripped ? SingleEnd::kSlipEnds : SingleEnd::kGivenUp;
        if (gripped) result.end_state = *gripped;
        return result;
    }
    result.next_seconds = next.next_seconds;
    if (next.guard >= 0) result.end = law.end(next.guard);
    if (!(next.seconds > 0)) return result;
    const Piece& piece = next.pieces[0];
    result.seconds = next.seconds;
    result.acceleration = piece.acceleration;
    result.spin_rate = piece.spin_rate;
    result.curve = *piece.curve;
    result.end_state = next.end_state[0];
    project(contact, mode, result.end_state);
    return result;
}

}  // namespace carom
