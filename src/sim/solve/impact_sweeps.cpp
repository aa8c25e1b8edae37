#include "sim/solve/impact_sweeps.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "sim/solve/contact_rows.h"

namespace carom {

namespace {

/// Sweeps over all contacts. A chain of n balls needs about n^2 of them a digit.
constexpr int kMostSweeps = 20'000;

/// A sweep that changes no velocity by more than this, relative to the largest approach, ends it.
constexpr double kConverged = 4 * std::numeric_limits<double>::epsilon();

/// So does one whose changes are roundings of the velocities: relative to the largest of those.
constexpr double kSpeedRounding = 2 * std::numeric_limits<double>::epsilon();

/// Below this changes may be roundings, larger where masses are far apart, that go round in
/// circles: then so many sweeps without a smaller one end it.
constexpr double kRoundings = 1e-12;
constexpr double kManyRoundings = 64;
constexpr int kMostIdle = 16;

}  // namespace

double fastest_centre(const std::vector<ImpactBody>& bodies) {
    double fastest = 0;
    for (const ImpactBody& b : bodies) fastest = std::max(fastest, b.velocities.linear.norm());
    return fastest;
}

void solve_by_gauss_seidel(std::vector<ImpactBody>& bodies, std::vector<Contact>& contacts) {
    std::vector<ContactRow> rows;
    rows.reserve(contacts.size());
    double scale = 0;
    for (const Contact& c : contacts) {
        rows.emplace_back(bodies, c, c.restitution * std::max(c.approach_speed, 0.0));
        scale = std::max(scale, std::abs(c.approach_speed));
    }
    const double rounding = kSpeedRounding * fastest_centre(bodies);
    // A row that was right stays so until one of its bodies changes.
    std::vector<std::int64_t> changed(bodies.size(), 0), right(rows.size(), -1);
    const auto last_change = [&](const Contact& c) {
        const std::int64_t of_ball = changed[static_cast<std::size_t>(c.ball)];
        return c.other.is_surface
                   ? of_ball
                   : std::max(of_ball, changed[static_cast<std::size_t>(c.other.index)]);
    };
    std::int64_t now = 0;
    const auto relax = [&](std::size_t i) {
        const Contact& c = contacts[i];
        if (right[i] >= last_change(c)) return 0.0;
        const double moved = rows[i].relax();
        right[i] = ++now;
        if (moved == 0) return 0.0;
        changed[static_cast<std::size_t>(c.ball)] = ++now;
        if (!c.other.is_surface) changed[static_cast<std::size_t>(c.other.index)] = now;
        return moved;
    };
    double least = std::numeric_limits<double>::infinity();
    int idle = 0;
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
        double moved = 0;
        for (std::size_t i = 0; i < rows.size(); ++i) moved = std::max(moved, relax(i));
        idle = moved < least ? 0 : idle + 1;
        least = std::min(least, moved);
        if (moved <= std::max(kConverged * scale, rounding)) break;
        if (moved <= std::max(kRoundings * scale, kManyRoundings * rounding) && idle > kMostIdle)
            break;
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        contacts[i].impulse = rows[i].normal;
        contacts[i].tangential_impulse = rows[i].tangential.norm();
    }
}

}  // namespace carom
