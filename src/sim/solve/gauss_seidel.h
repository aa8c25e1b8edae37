// Projected Gauss-Seidel: the one iteration of all solvers that go from contact to contact.
//
// A row is a contact. To relax it is to give it the impulse with which it obeys Newton's law,
// w_n >= target with an impulse that only pushes, and Coulomb's true cone, the impulses of all
// others as they are (J. J. Moreau, "Unilateral contact and dry friction in finite freedom
// dynamics", 1988). Momentum is exact whenever the iteration ends. What bodies and rows are made
// of, and when it ends, is the caller's: contact_rows.h for impacts and islands,
// group/pile_solver.h for piles.
#pragma once

#include <algorithm>
#include <cstddef>

namespace carom {

enum class SweepOrder {
    kForward,
    kThereAndBack  ///< every other sweep backwards: what passes through a pile goes both ways
};

/// Relaxes all rows again and again, at most `most` times. `rows` has size() and relax(i), which
/// returns the change of speed [m/s] that the row needed, or whether it needed one. Ends when
/// `ends(largest)`, asked after each sweep with the largest change of it, says so.
template <class Rows, class Ends>
void gauss_seidel(Rows& rows, SweepOrder order, int most, Ends&& ends) {
    const std::size_t size = rows.size();
    for (int sweep = 0; sweep < most; ++sweep) {
        auto largest = decltype(rows.relax(std::size_t{})){};
        if (order == SweepOrder::kForward || sweep % 2 == 0)
            for (std::size_t i = 0; i < size; ++i) largest = std::max(largest, rows.relax(i));
        else
            for (std::size_t i = size; i-- > 0;) largest = std::max(largest, rows.relax(i));
        if (ends(largest)) return;
    }
}

}  // namespace carom
