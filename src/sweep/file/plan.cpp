#include "sweep/file/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace carom {

namespace {

/// A product that stops growing where nobody can mean it.
std::int64_t grid_size(const Sweep& sweep) {
    double size = 1;
    for (const SweepAxis& axis : sweep.axes) size *= static_cast<double>(axis.draw.levels());
    constexpr double kMost = 1e15;
    return static_cast<std::int64_t>(std::min(size, kMost));
}

std::int64_t longest(const Sweep& sweep) {
    std::int64_t most = 1;
    for (const SweepAxis& axis : sweep.axes) most = std::max(most, axis.draw.levels());
    return most;
}

std::int64_t count_of(const Sweep& sweep) {
    if (sweep.mode == SweepMode::kGrid) return grid_size(sweep);
    return sweep.mode == SweepMode::kZip ? longest(sweep) : sweep.count;
}

/// Which part of each axis a run of a Latin hypercube meets (McKay, Beckman, Conover, "A comparison
/// of three methods for selecting values of input variables", Technometrics 21, 1979): Fisher and
/// Yates' shuffle.
std::vector<std::int32_t> permutation(std::uint64_t seed, const std::string& path,
                                      std::int64_t count) {
    std::vector<std::int32_t> order(static_cast<std::size_t>(count));
    std::iota(order.begin(), order.end(), 0);
    for (std::int64_t i = count - 1; i > 0; --i) {
        const double u = drawn_number(seed, path, i, -1);
        const auto j = static_cast<std::size_t>(u * static_cast<double>(i + 1));
        std::swap(order[static_cast<std::size_t>(i)], order[j]);
    }
    return order;
}

}  // namespace

void check_mode(const Sweep& sweep, const Node& root, Report& report) {
    const bool counted = sweep.mode == SweepMode::kLhs || sweep.mode == SweepMode::kRandom;
    const Node* count = root.find("count");
    const Node* mode = root.find("mode");
    if (counted && count == nullptr)
        report.error(*mode,
                     fmt::format("mode {} wants 'count', how many runs it makes", mode->text));
    if (!counted && count != nullptr)
        report.error_at_key(*count,
                            "'count' is for the modes lhs and random; in a grid or zip the "
                            "axes say how many runs there are");
    // A Latin hypercube is shuffled before its first run: 2 s and 80 MB.
    constexpr std::int64_t kMostShuffled = 20'000'000;
    const auto axes = static_cast<std::int64_t>(sweep.axes.size());
    if (sweep.mode == SweepMode::kLhs && axes > 0 && sweep.count > kMostShuffled / axes)
        report.error(*mode, fmt::format("{} runs of {} axes are too many to be spread evenly: mode "
                                        "lhs takes runs times axes up to {}; mode random any",
                                        sweep.count, axes, kMostShuffled));
    if (counted) {
        for (const SweepAxis& axis : sweep.axes)
            if (axis.draw.is_random() && axis.draw.levels() > 1)
                report.error_in_source(axis.origin.source, axis.origin.mark,
                                       fmt::format("'draws' of {} is for the modes grid and zip; "
                                                   "here 'count' says how many there are",
                                                   axis.path));
        return;
    }
    if (sweep.mode == SweepMode::kZip)
        for (const SweepAxis& axis : sweep.axes)
            if (axis.draw.levels() != 1 && axis.draw.levels() != longest(sweep))
                report.error_in_source(
                    axis.origin.source, axis.origin.mark,
                    fmt::format("{} has {} values and another axis {}: in mode zip all have as "
                                "many, or one",
                                axis.path, axis.draw.levels(), longest(sweep)));
    if (count_of(sweep) > kMostRuns)
        report.error(root, fmt::format("this makes {} runs or more; at most {} are made",
                                       count_of(sweep), kMostRuns));
}

Plan::Plan(const Sweep& sweep) : sweep_(sweep), count_(count_of(sweep)) {
    strides_.assign(sweep.axes.size(), 1);
    if (sweep.mode == SweepMode::kGrid)
        for (std::size_t i = sweep.axes.size(); i-- > 1;)
            strides_[i - 1] = strides_[i] * sweep.axes[i].draw.levels();
    if (sweep.mode == SweepMode::kLhs)
        for (const SweepAxis& axis : sweep.axes)
            permutations_.push_back(permutation(sweep.seed, axis.path, count_));
}

Node Plan::level(std::size_t axis, std::int64_t index) const {
    const SweepAxis& one = sweep_.axes[axis];
    if (!one.draw.is_random()) return one.draw.level(index);
    return one.draw.at(drawn_number(sweep_.seed, one.path, index));
}

Node Plan::value(std::size_t axis, std::int64_t run) const {
    const SweepAxis& one = sweep_.axes[axis];
    const std::int64_t levels = one.draw.levels();
    switch (sweep_.mode) {
        case SweepMode::kGrid:
            return level(axis, run / strides_[axis] % levels);
        case SweepMode::kZip:
            return level(axis, levels == 1 ? 0 : run);
        case SweepMode::kRandom:
            return one.draw.at(drawn_number(sweep_.seed, one.path, run));
        case SweepMode::kLhs:
            break;
    }
    const double part = permutations_[axis][static_cast<std::size_t>(run)];
    const double u = drawn_number(sweep_.seed, one.path, run);
    return one.draw.at((part + u) / static_cast<double>(count_));
}

std::vector<Node> Plan::values(std::int64_t run) const {
    std::vector<Node> all;
    for (std::size_t i = 0; i < sweep_.axes.size(); ++i) all.push_back(value(i, run));
    return all;
}

}  // namespace carom
