#include "sim/integrate/piece_end.h"

#include <array>
#include <optional>

#include "sim/math/event_location.h"

namespace carom {

namespace {

/// An incipient slip follows what drives it up to this fraction of the speeds. Its own direction
/// lags by (turning rate) (slip) / (drive), which leaves 1e-11 of a speed.
constexpr double kSmallSlip = 1e-7;

/// What must stay >= 0 in a piece, one after the other.
class Gates {
  public:
    explicit Gates(const Course& course) : course_(course) {}

    int count() const {
        const CurvedMode mode = course_.mode();
        const int own = mode == CurvedMode::kRolling ? 1 : mode == CurvedMode::kIncipient ? 2 : 0;
        return 1 + course_.contact().gate_count + own;
    }
    CurvedEnd end(int i) const {
        if (i == 0) return CurvedEnd::kLiftOff;
        if (i <= course_.contact().gate_count) return CurvedEnd::kFeature;
        if (course_.mode() == CurvedMode::kRolling) return CurvedEnd::kGripEnds;
        return i == course_.contact().gate_count + 1 ? CurvedEnd::kSlipGrows : CurvedEnd::kSlipEnds;
    }
    double value(int i, const CurvedState& state) const {
        const CurvedContact& c = course_.contact();
        if (i > 0 && i <= c.gate_count)
            return c.gates[static_cast<std::size_t>(i - 1)].room(state.x);
        const CurvedForces f = course_.forces(state);
        switch (end(i)) {
            case CurvedEnd::kLiftOff:
                return f.push - least_push(c, state.x);
            case CurvedEnd::kGripEnds:
                return grip_left(c, f);
            case CurvedEnd::kSlipGrows:
                return kSmallSlip * course_.speed() - f.slip.norm();
            default:
                return f.slip.dot(f.drive);  // the slip goes back to 0
        }
    }

  private:
    const Course& course_;
};

/// One gate along a piece.
class Lookout {
  public:
    Lookout(const Course& course, const Piece& piece, const Gates& gates)
        : course_(course), piece_(piece), gates_(gates), h_(piece.curve->seconds) {
        for (std::size_t j = 0; j <= kGateLooks; ++j) states_[j] = on_piece(gate_place(h_, j));
    }

    /// The first crossing of gate i before `limit`, or none.
    Crossing find(int i, double limit, bool settled) const {
        const GateLooks gate(
            h_, [&](std::size_t j) { return gates_.value(i, states_[j]); },
            [&](double s) { return gates_.value(i, on_piece(s)); });
        const auto on_course = [&](double s) { return gates_.value(i, exact(s)); };
        const bool gone_back = gates_.end(i) == CurvedEnd::kSlipEnds;
        const std::optional<double> s = gate.first_negative(on_course, limit, settled || gone_back);
        return s ? Crossing{*s, gates_.end(i)} : Crossing{};
    }

  private:
    CurvedState on_piece(double s) const {
        return {course_.start().x + piece_.position_at(s), piece_.velocity_at(s),
                piece_.spin_at(s)};
    }
    CurvedState exact(double s) const {
        Numbers y = course_.first();
        course_.advance(y, s);
        return course_.state(y);
    }

    const Course& course_;
    const Piece& piece_;
    const Gates& gates_;
    double h_;
    std::array<CurvedState, kGateLooks + 1> states_;
};

}  // namespace

Crossing first_crossing(const Course& course, const Piece& piece, bool settled) {
    const Gates gates(course);
    const Lookout lookout(course, piece, gates);
    Crossing first;
    for (int i = 0; i < gates.count(); ++i) {
        const Crossing crossing = lookout.find(i, first.seconds, settled);
        if (crossing.end == CurvedEnd::kNone) continue;
        if (crossing.seconds == 0) return crossing;
        if (crossing.seconds < first.seconds) first = crossing;
    }
    return first;
}

}  // namespace carom
