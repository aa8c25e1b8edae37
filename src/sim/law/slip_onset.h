// Slips that begin where friction cannot prevent them: in which directions.
#pragma once

#include <span>

#include "sim/law/coupled_equations.h"

namespace carom {

/// A slip s that begins has the direction d in which it grows under the friction against itself:
///   s' - |s| d' = s0 - |s| d' + sum of A f is along d, with f = -mu N d and N = N0 + sum of b . f,
/// the sums over all slips that begin at the same time. s0, A, N0 and b are found by probing: the
/// forces of the whole system without this friction, and with a unit of it at each.
class SlipOnset {
  public:
    SlipOnset(const CoupledContacts& system, const ContactMotions& at);

    std::size_t count() const { return count_; }
    /// How fast the slips' directions turn (d', 1/s) and how large they are; without it they are 0.
    void set_turning(const ContactMotions& at, std::span<const Vec3> turning);
    /// The friction of probe i, 0 ... 2 count().
    std::span<const ForceRow> probe(std::size_t i);
    void take(std::size_t i, const CoupledForces& forces);

    /// Once all probes are taken.
    std::span<const ForceRow> friction();
    void fill_directions(CoupledForces& forces) const;

  private:
    using Vec2 = Eigen::Vector2d;
    struct Start {
        std::size_t contact = 0;
        double mu = 0, unit = 1;
        Vec3 n, t, u;
        Vec2 s0, d, f, lag = Vec2::Zero();
        double n0 = 0;
        std::array<Eigen::Matrix2d, kMostCoupledContacts> a;
        std::array<Vec2, kMostCoupledContacts> b;
    };
    Vec2 seen(const Start& start, const CoupledForces& forces) const;
    double settle(Start& start) const;

    std::array<Start, kMostCoupledContacts> starts_;
    std::array<ForceRow, kMostCoupledContacts> rows_;
    std::size_t count_ = 0;
};

}  // namespace carom
