#include "sim/solve/island_sweeps.h"

#include <algorithm>

#include "sim/solve/contact_rows.h"

namespace carom {

namespace {

/// Sweeps there and back in one step. A pile passes a force on by about one layer in each, and the
/// next step continues.
constexpr int kSweeps = 10;

/// A sweep that changes no speed by more than this [m/s] ends it: far below what counts as calm.
constexpr double kConverged = 1e-9;

}  // namespace

void solve_island_by_gauss_seidel(std::vector<ImpactBody>& bodies,
                                  const std::vector<Contact>& contacts,
                                  const std::vector<double>& targets, std::vector<Vec3>& pushes) {
    std::vector<ContactRow> rows;
    rows.reserve(contacts.size());
    for (std::size_t i = 0; i < contacts.size(); ++i)
        rows.emplace_back(bodies, contacts[i], targets[i]).start_from(pushes[i]);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        double moved = 0;
        for (ContactRow& row : rows) moved = std::max(moved, row.relax());
        for (std::size_t i = rows.size(); i-- > 0;) moved = std::max(moved, rows[i].relax());
        if (moved <= kConverged) break;
    }
    for (std::size_t i = 0; i < rows.size(); ++i)
        pushes[i] = rows[i].normal * contacts[i].normal + rows[i].tangential;
}

}  // namespace carom
