#include "sim/solve/contact_sweeps.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "sim/solve/contact_rows.h"
#include "sim/solve/gauss_seidel.h"

namespace carom {

namespace {

/// Sweeps over all contacts. A chain of n balls needs about n^2 of them a digit.
constexpr int kMostSweeps = 20'000;

/// A sweep that changes no velocity by more than this, relative to the largest approach, ends it.
constexpr double kConverged = 4 * std::numeric_limits<double>::epsilon();

/// So does one whose changes are roundings of the velocities: relative to the largest of those.
constexpr double kSweepSpeedRounding = 2 * std::numeric_limits<double>::epsilon();

/// Below this changes may be roundings, larger where masses are far apart, that go round in
/// circles: then so many sweeps without a smaller one end it.
constexpr double kRoundings = 1e-12;
constexpr double kManyRoundings = 64;
constexpr int kMostIdle = 16;

/// Sweeps there and back in one step of an island. A pile passes a force on by about one layer in
/// each, and the next step continues.
constexpr int kIslandSweeps = 10;

/// Sweeps there and back that change no speed by more than this [m/s] end it: far below what counts
/// as calm.
constexpr double kIslandConverged = 1e-9;

struct ContactRows {
    std::vector<ContactRow> all;
    std::size_t size() const { return all.size(); }
    double relax(std::size_t i) { return all[i].relax(); }
};

/// The same, where a row that was right is left alone until one of its bodies changes.
class LazyRows {
  public:
    LazyRows(std::vector<ImpactBody>& bodies, const std::vector<SolverContact>& contacts)
        : contacts_(contacts), changed_(bodies.size(), 0), right_(contacts.size(), -1) {
        rows_.all.reserve(contacts.size());
        for (const SolverContact& c : contacts)
            rows_.all.emplace_back(bodies, c, c.restitution * std::max(c.approach_speed, 0.0));
    }
    std::size_t size() const { return rows_.size(); }
    const ContactRow& row(std::size_t i) const { return rows_.all[i]; }
    double relax(std::size_t i) {
        const SolverContact& c = contacts_[i];
        if (right_[i] >= last_change(c)) return 0;
        const double moved = rows_.relax(i);
        right_[i] = ++now_;
        if (moved == 0) return 0;
        at(c.body) = ++now_;
        if (!c.on_surface()) at(c.other_body) = now_;
        return moved;
    }

  private:
    std::int64_t& at(int body) { return changed_[static_cast<std::size_t>(body)]; }
    std::int64_t last_change(const SolverContact& c) {
        return c.on_surface() ? at(c.body) : std::max(at(c.body), at(c.other_body));
    }

    ContactRows rows_;
    const std::vector<SolverContact>& contacts_;
    std::vector<std::int64_t> changed_;  ///< per body, when a row last changed it
    std::vector<std::int64_t> right_;    ///< per row, when it was last relaxed
    std::int64_t now_ = 0;               ///< counts both
};

}  // namespace

double fastest_centre(const std::vector<ImpactBody>& bodies) {
    double fastest = 0;
    for (const ImpactBody& b : bodies) fastest = std::max(fastest, b.velocities.linear.norm());
    return fastest;
}

void solve_by_gauss_seidel(std::vector<ImpactBody>& bodies, std::vector<SolverContact>& contacts) {
    LazyRows rows(bodies, contacts);
    double scale = 0;
    for (const SolverContact& c : contacts) scale = std::max(scale, std::abs(c.approach_speed));
    const double rounding = kSweepSpeedRounding * fastest_centre(bodies);
    double least = std::numeric_limits<double>::infinity();
    int idle = 0;
    gauss_seidel(rows, SweepOrder::kForward, kMostSweeps, [&](double moved) {
        idle = moved < least ? 0 : idle + 1;
        least = std::min(least, moved);
        if (moved <= std::max(kConverged * scale, rounding)) return true;
        return moved <= std::max(kRoundings * scale, kManyRoundings * rounding) && idle > kMostIdle;
    });
    for (std::size_t i = 0; i < rows.size(); ++i) {
        contacts[i].impulse = rows.row(i).normal;
        contacts[i].tangential_impulse = rows.row(i).tangential.norm();
    }
}

void solve_island_by_gauss_seidel(std::vector<ImpactBody>& bodies,
                                  const std::vector<SolverContact>& contacts,
                                  const std::vector<double>& targets, std::vector<Vec3>& pushes) {
    ContactRows rows;
    rows.all.reserve(contacts.size());
    for (std::size_t i = 0; i < contacts.size(); ++i)
        rows.all.emplace_back(bodies, contacts[i], targets[i]).start_from(pushes[i]);
    bool back = true;
    double there = 0;
    gauss_seidel(rows, SweepOrder::kThereAndBack, 2 * kIslandSweeps, [&](double moved) {
        back = !back;
        if (back) return std::max(there, moved) <= kIslandConverged;
        there = moved;
        return false;
    });
    for (std::size_t i = 0; i < rows.size(); ++i)
        pushes[i] = rows.all[i].normal * contacts[i].normal + rows.all[i].tangential;
}

}  // namespace carom
