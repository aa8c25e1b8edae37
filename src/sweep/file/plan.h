// Which runs a sweep has: their number and the values of each.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/report.h"
#include "sweep/file/sweep_file.h"

namespace carom {

/// More cannot be named, counted and listed in bearable time.
inline constexpr std::int64_t kMostRuns = 10'000'000;

/// Refuses what the mode cannot take: columns of different length in `zip`, a `count` that is
/// missing or means nothing. `root` is the file's mapping.
void check_mode(const Sweep& sweep, const Node& root, Report& report);

/// Of a sweep that check_mode() has nothing against. Shared by threads.
class Plan {
  public:
    /// `sweep` must outlive it.
    explicit Plan(const Sweep& sweep);

    std::int64_t count() const { return count_; }
    /// The value of each axis in run 0 <= run < count(); it depends on the file and on `run` alone.
    std::vector<Node> values(std::int64_t run) const;

  private:
    Node value(std::size_t axis, std::int64_t run) const;
    Node level(std::size_t axis, std::int64_t index) const;

    const Sweep& sweep_;
    std::int64_t count_ = 1;
    std::vector<std::int64_t> strides_;                    ///< of a grid, by axis
    std::vector<std::vector<std::int32_t>> permutations_;  ///< of a Latin hypercube, by axis
};

}  // namespace carom
