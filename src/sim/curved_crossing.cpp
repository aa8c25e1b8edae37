#include "sim/curved_crossing.h"

#include <array>

#include "sim/bracketed_root.h"

namespace carom {

namespace {

/// An incipient slip follows what drives it up to this fraction of the speeds. Its own direction
/// lags by (turning rate) (slip) / (drive), which leaves 1e-11 of a speed.
constexpr double kSmallSlip = 1e-7;

/// Events are looked for at so many places of a piece, which is short against its motion.
constexpr int kLooks = 8;

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

/// The lowest place of a function between two others that are higher, by thirds.
double lowest_between(const auto& f, double lo, double hi) {
    constexpr int kThirds = 40;
    for (int i = 0; i < kThirds; ++i) {
        const double a = lo + (hi - lo) / 3, b = hi - (hi - lo) / 3;
        (f(a) < f(b) ? hi : lo) = f(a) < f(b) ? b : a;
    }
    return 0.5 * (lo + hi);
}

/// One gate along a piece.
class Lookout {
  public:
    Lookout(const Course& course, const Piece& piece, const Gates& gates)
        : course_(course), piece_(piece), gates_(gates), h_(piece.curve->seconds) {
        for (int j = 0; j <= kLooks; ++j) states_[static_cast<std::size_t>(j)] = on_piece(place(j));
    }

    /// The first crossing of gate i before `limit`, or none.
    Crossing find(int i, double limit, bool settled) const {
        std::array<double, kLooks + 1> looks;
        for (std::size_t j = 0; j <= kLooks; ++j) looks[j] = gates_.value(i, states_[j]);
        double above = -1;  // the last place where it was above 0
        for (int j = 0; j <= kLooks && place(j - 1) <= limit; ++j) {
            const double here = looks[static_cast<std::size_t>(j)];
            if (here > 0) above = place(j);
            double below = here < 0 && j > 0 ? place(j) : -1;
            if (const double dip = dip_at(i, j, looks); dip >= 0) {
                below = dip;
                if (dip < above) above = place(j - 1);
            }
            if (below < 0) continue;
            if (above < 0) {
                // It was never above 0: over at once, unless that has been tried.
                const bool gone_back = gates_.end(i) == CurvedEnd::kSlipEnds;
                if (settled || gone_back) continue;
                return {0, gates_.end(i)};
            }
            const auto on_course = [&](double s) { return gates_.value(i, exact(s)); };
            return {bracketed_root(on_course, above, below), gates_.end(i)};
        }
        return {};
    }

  private:
    double place(int j) const { return h_ * j / kLooks; }
    /// Where a gate that is open at look j and around it dips below 0 in between; -1 for nowhere.
    double dip_at(int i, int j, const std::array<double, kLooks + 1>& looks) const {
        if (j == 0 || j == kLooks) return -1;
        const auto k = static_cast<std::size_t>(j);
        if (!(looks[k] > 0 && looks[k] <= looks[k - 1] && looks[k] < looks[k + 1])) return -1;
        const auto on_fit = [&](double t) { return gates_.value(i, on_piece(t)); };
        const double s = lowest_between(on_fit, place(j - 1), place(j + 1));
        return on_fit(s) < 0 ? s : -1;
    }
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
    std::array<CurvedState, kLooks + 1> states_;
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
