#include "sim/solve/coulomb_impact.h"

#include <array>
#include <limits>

#include "sim/solve/contact_rows.h"
#include "sim/solve/coulomb_laws.h"

namespace carom {

namespace {

/// The equations hold when what is left is so many roundings of their terms.
constexpr double kSolved = 64 * std::numeric_limits<double>::epsilon();

/// What another solver's answer may leave of them, relative to their terms.
constexpr double kObeyed = 1e-12;

/// Newton's method is quadratic once the contacts that grip, slip and open are found; a few dozen
/// contacts change them some ten times.
constexpr int kMostNewton = 20;

/// Parts of a step that are tried, when the full one leads away.
constexpr std::array<double, 5> kSteps = {1, 0.5, 0.25, 0.125, 0.0625};

/// Where it ends beside the solution, some relaxations of all contacts lead it to another start.
constexpr int kMostStarts = 6;
constexpr int kRelaxations = 25;

/// The largest share of restitution is found to rounding. One below the second number is none: what
/// is jammed stays so.
constexpr double kShareRounding = 2 * std::numeric_limits<double>::epsilon();
constexpr double kLeastShare = 1e-6;

double left_of(const Eigen::VectorXd& residual) { return residual.cwiseAbs().maxCoeff(); }

/// The least step to a root where there are several, so that what is symmetric stays so.
Eigen::VectorXd newton_step(const CoulombLaws& laws, const Eigen::VectorXd& y,
                            const Eigen::VectorXd& residual) {
    return laws.jacobian(y).completeOrthogonalDecomposition().solve(-residual);
}

bool is_root(const CoulombLaws& laws, const Eigen::VectorXd& y, const Eigen::VectorXd& residual) {
    return left_of(residual) <= kSolved * laws.scale(y);
}

/// Newton's method with full steps, which finds the contacts that grip, slip and open also where
/// that leads away at first. Whether `y` has become a root.
bool jump(const CoulombLaws& laws, Eigen::VectorXd& y) {
    for (int i = 0; i < kMostNewton; ++i) {
        const Eigen::VectorXd residual = laws.residual(y);
        if (!residual.allFinite()) return false;
        if (is_root(laws, y, residual)) return true;
        y += newton_step(laws, y, residual);
    }
    return false;
}

/// The same with steps that do not lead away.
bool descend(const CoulombLaws& laws, Eigen::VectorXd& y) {
    Eigen::VectorXd residual = laws.residual(y);
    for (int i = 0; i < kMostNewton; ++i) {
        if (is_root(laws, y, residual)) return true;
        const Eigen::VectorXd step = newton_step(laws, y, residual);
        bool closer = false;
        for (const double part : kSteps) {
            const Eigen::VectorXd next = y + part * step;
            const Eigen::VectorXd next_residual = laws.residual(next);
            if (!(next_residual.norm() < residual.norm())) continue;
            y = next;
            residual = next_residual;
            closer = true;
            break;
        }
        if (!closer) return false;
    }
    return false;
}

bool converge(const CoulombLaws& laws, const Eigen::VectorXd& start, Eigen::VectorXd& y) {
    y = start;
    if (descend(laws, y)) return true;
    y = start;
    return jump(laws, y);
}

/// Impulses that obey both laws without a gain of energy: from `y`, from none, or from what so many
/// relaxations make of them.
bool find_impulses(CoulombLaws& laws, double share, int starts, Eigen::VectorXd& y) {
    laws.set_share(share);
    const auto found = [&laws, &y] { return !laws.squeezes(y) && !laws.gains_energy(y); };
    if (converge(laws, Eigen::VectorXd(y), y)) return found();
    Eigen::VectorXd start = laws.no_impulses();
    for (int k = 0; k < starts; ++k) {
        for (int i = 0; i < kRelaxations; ++i) k % 2 == 0 ? laws.relax(start) : laws.sweep(start);
        if (converge(laws, start, y)) return found();
    }
    return false;
}

/// At the largest share of restitution that has impulses.
bool find_largest_share(CoulombLaws& laws, Eigen::VectorXd& y) {
    y = laws.no_impulses();
    if (find_impulses(laws, 1, kMostStarts, y)) return true;
    Eigen::VectorXd best = laws.no_impulses();
    if (!find_impulses(laws, 0, kMostStarts, best)) return false;
    double share = 0, beyond = 1;
    while (beyond - share > kShareRounding && beyond > kLeastShare) {
        const double middle = 0.5 * (share + beyond);
        y = best;
        if (find_impulses(laws, middle, 1, y)) {
            share = middle;
            best = y;
        } else {
            beyond = middle;
        }
    }
    y = best;
    return true;
}

}  // namespace

bool solve_with_friction(std::vector<ImpactBody>& bodies, std::vector<SolverContact>& contacts) {
    CoulombLaws laws(bodies, contacts);
    Eigen::VectorXd y;
    if (!find_largest_share(laws, y)) return false;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        SolverContact& c = contacts[i];
        const Vec3 impulse = laws.impulse(i, y);
        ContactRow(bodies, c, 0).push(impulse);
        c.impulse = std::max(impulse.dot(c.normal), 0.0);
        c.tangential_impulse = tangential_part(impulse, c.normal).norm();
    }
    return true;
}

bool obeys_friction(const std::vector<ImpactBody>& before,
                    const std::vector<SolverContact>& contacts, const std::vector<Vec3>& impulses) {
    const CoulombLaws laws(before, contacts);
    const Eigen::VectorXd y = laws.unknowns_of(impulses);
    return left_of(laws.residual(y)) <= kObeyed * laws.scale(y);
}

}  // namespace carom
