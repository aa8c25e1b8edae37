// The iteration of all Gauss-Seidel solvers, on rows whose solution is known.
#include "sim/solve/gauss_seidel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace carom {
namespace {

/// A x = b with 2 on the diagonal of A and -1 beside it: row i has x[i] = (b + x[i-1] + x[i+1])
/// / 2.
struct Chain {
    explicit Chain(std::size_t n) : x(n, 0) {}
    std::size_t size() const { return x.size(); }
    double relax(std::size_t i) {
        order.push_back(i);
        const double left = i > 0 ? x[i - 1] : 0, right = i + 1 < x.size() ? x[i + 1] : 0;
        const double wanted = 0.5 * (1 + left + right), change = std::abs(wanted - x[i]);
        x[i] = wanted;
        return change;
    }
    std::vector<double> x;
    std::vector<std::size_t> order;
};

TEST(GaussSeidel, ConvergesToTheSolution) {
    constexpr std::size_t kRows = 9;
    for (const SweepOrder order : {SweepOrder::kForward, SweepOrder::kThereAndBack}) {
        Chain chain(kRows);
        int sweeps = 0;
        gauss_seidel(chain, order, 10'000, [&](double largest) {
            ++sweeps;
            return largest < 1e-14;
        });
        EXPECT_LT(sweeps, 1000);
        for (std::size_t i = 0; i < kRows; ++i) {  // x_i = (i + 1) (n - i) / 2
            const double exact = 0.5 * static_cast<double>((i + 1) * (kRows - i));
            EXPECT_NEAR(chain.x[i], exact, 1e-12) << i;
        }
    }
}

TEST(GaussSeidel, GoesForwardOrThereAndBack) {
    Chain forward(3), both(3);
    gauss_seidel(forward, SweepOrder::kForward, 2, [](double) { return false; });
    gauss_seidel(both, SweepOrder::kThereAndBack, 2, [](double) { return false; });
    EXPECT_EQ(forward.order, (std::vector<std::size_t>{0, 1, 2, 0, 1, 2}));
    EXPECT_EQ(both.order, (std::vector<std::size_t>{0, 1, 2, 2, 1, 0}));
}

TEST(GaussSeidel, EndsWhenAskedTo) {
    Chain chain(3);
    double seen = -1;
    gauss_seidel(chain, SweepOrder::kForward, 100, [&seen](double largest) {
        seen = largest;
        return true;
    });
    EXPECT_EQ(chain.order.size(), 3u);
    EXPECT_EQ(seen, 0.875) << "the last row's, 1/2 + 1/4 + 1/8";
}

}  // namespace
}  // namespace carom
