// A value that a sweep varies: a list, a range, or a draw from a distribution.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/document.h"
#include "scene/keys.h"
#include "scene/report.h"

namespace carom {

/// From the seed, what is drawn, which one of them, and a further number: the same for the same
/// four, whatever else is drawn, on every machine (XXH3). Uniform in [0, 1).
double drawn_number(std::uint64_t seed, std::string_view what, std::int64_t item,
                    std::int64_t further = 0);

/// A list or range has so many values, one after the other; a draw has a value for each u.
class Draw {
  public:
    /// Of a validated node. A list is one of its values, unless `list_is_value`; a scalar is itself
    /// always. What the table of keys cannot see goes to `report`: none then.
    static std::optional<Draw> read(const Node& node, bool list_is_value, const KeyTable& table,
                                    Report& report);

    /// Not a list, a range or one value.
    bool is_random() const { return kind_ > Kind::kRange; }
    /// False of a normal distribution that is not cut off: any value may come.
    bool has_ends() const;
    /// Of a list or a range how many values, of a draw how many are wanted in a grid.
    std::int64_t levels() const;
    /// 0 <= index < levels(), of what is not random.
    Node level(std::int64_t index) const;
    /// The value below which the part u, in [0, 1), of all draws lies; of a list or range each
    /// value is equally likely.
    Node at(double u) const;
    /// Values that stand in the file.
    const std::vector<Node>& values() const { return values_; }

  private:
    enum class Kind { kValues, kRange, kUniform, kLogUniform, kNormal, kInteger, kChoice };

    bool read_range(const Node& node, const KeyTable& table, Report& report);
    bool read_choice(const Node& node, Report& report);
    bool read_normal(const Node& node, Report& report);
    bool read_bounds(const Node& bounds, Kind kind, Report& report);
    bool refuse_strangers(const Node& node, Report& report) const;
    double number_at(double u) const;
    Node made(double number) const;

    Kind kind_ = Kind::kValues;
    std::vector<Node> values_;
    std::vector<double> summed_weights_;  ///< of choice; ends with 1
    double a_ = 0, b_ = 1;                ///< bounds; of normal the mean and the deviation
    double low_ = 0, high_ = 1;           ///< of normal: the parts below the bounds of `within`
    double within_low_ = 0, within_high_ = 0;
    std::int64_t steps_ = 1, draws_ = 1;
    bool log_ = false;
    int source_ = 0;
    SourceMark mark_;
};

/// As one line of YAML, which reads back as the same: a number, a word, [1, 2], {a: 1}.
std::string flow_text(const Node& node);

}  // namespace carom
