#include "sweep/file/draw.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/checksum.h"
#include "scene/fields.h"
#include "scene/scalar.h"

namespace carom {

namespace {

/// 0.30000000000000004 is 0.3: nobody means the last digit of a range.
double rounded(double value) {
    const std::string text = fmt::format("{:.15g}", value);
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

/// The standard normal distribution's part below x, and the other way round.
double normal_part(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }
double normal_quantile(double part) {
    constexpr double kLeast = 1e-300, kMost = 1 - 1e-16;  // 0 and 1 are infinitely far out
    return -std::numbers::sqrt2 * boost::math::erfc_inv(2 * std::clamp(part, kLeast, kMost));
}

double number_of(const Node& list, std::size_t index) { return node_number(list.children[index]); }

}  // namespace

double drawn_number(std::uint64_t seed, std::string_view what, std::int64_t item,
                    std::int64_t further) {
    constexpr double kTwoToMinus53 = 1.0 / 9007199254740992.0;
    const std::int64_t numbers[] = {static_cast<std::int64_t>(seed), item, further};
    Checksum sum;
    sum.add(numbers, sizeof numbers);
    sum.add(what.data(), what.size());
    return static_cast<double>(sum.value() >> 11U) * kTwoToMinus53;
}

std::optional<Draw> Draw::read(const Node& node, bool list_is_value, const KeyTable& table,
                               Report& report) {
    Draw draw;
    draw.source_ = node.source;
    draw.mark_ = node.mark;
    if (node.kind == Node::Kind::kList && !list_is_value) {
        draw.values_ = node.children;
        return draw;
    }
    if (node.kind != Node::Kind::kMap) {
        draw.values_ = {node};
        return draw;
    }
    if (!draw.refuse_strangers(node, report)) return std::nullopt;
    if (const Node* draws = node.find("draws"))
        draw.draws_ = static_cast<std::int64_t>(node_number(*draws));
    bool right = false;
    if (node.find("from") != nullptr) {
        right = draw.read_range(node, table, report);
    } else if (node.find("choice") != nullptr) {
        right = draw.read_choice(node, report);
    } else if (node.find("normal") != nullptr) {
        right = draw.read_normal(node, report);
    } else if (const Node* bounds = node.find("uniform")) {
        right = draw.read_bounds(*bounds, Kind::kUniform, report);
    } else if (const Node* logs = node.find("log_uniform")) {
        right = draw.read_bounds(*logs, Kind::kLogUniform, report);
    } else if (const Node* whole = node.find("integer")) {
        right = draw.read_bounds(*whole, Kind::kInteger, report);
    }
    return right ? std::optional(draw) : std::nullopt;
}

/// Keys that belong to another kind of draw would be read by nobody.
bool Draw::refuse_strangers(const Node& node, Report& report) const {
    struct Belongs {
        const char *key, *to;
    };
    constexpr Belongs kAll[] = {{"to", "from"},        {"steps", "from"},    {"scale", "from"},
                                {"weights", "choice"}, {"within", "normal"}, {"from", "to"},
                                {"from", "steps"}};
    bool right = true;
    for (const Belongs& one : kAll) {
        const Node* key = node.find(one.key);
        if (key == nullptr || node.find(one.to) != nullptr) continue;
        report.error_at_key(*key, fmt::format("'{}' wants '{}' beside it", one.key, one.to));
        right = false;
    }
    if (const Node* draws = node.find("draws"); draws != nullptr && node.find("from") != nullptr) {
        report.error_at_key(*draws, "'draws' is for draws; a range has 'steps'");
        right = false;
    }
    return right;
}

bool Draw::read_range(const Node& node, const KeyTable& table, Report& report) {
    const Fields fields(table, Section::kSweepDraw, &node);
    kind_ = Kind::kRange;
    a_ = *fields.maybe_number("from");
    b_ = *fields.maybe_number("to");
    steps_ = fields.integer("steps");
    log_ = fields.word("scale") == "log";
    if (log_ && (a_ <= 0 || b_ <= 0)) {
        report.error(*node.find(a_ <= 0 ? "from" : "to"),
                     "a range of scale log lies above 0 at both ends");
        return false;
    }
    if (steps_ == 1 && a_ != b_) {
        report.error(*node.find("steps"), "a range with both ends has at least 2 steps");
        return false;
    }
    return true;
}

bool Draw::read_choice(const Node& node, Report& report) {
    kind_ = Kind::kChoice;
    values_ = node.find("choice")->children;
    const Node* weights = node.find("weights");
    double sum = 0;
    if (weights != nullptr && weights->children.size() != values_.size()) {
        report.error(*weights, fmt::format("{} weights for {} values", weights->children.size(),
                                           values_.size()));
        return false;
    }
    for (std::size_t i = 0; i < values_.size(); ++i)
        summed_weights_.push_back(sum += weights != nullptr ? number_of(*weights, i) : 1);
    if (sum <= 0 || !std::isfinite(sum)) {
        report.error(*weights, "at least one weight must be above 0");
        return false;
    }
    for (double& one : summed_weights_) one /= sum;
    return true;
}

bool Draw::read_normal(const Node& node, Report& report) {
    const Node& normal = *node.find("normal");
    kind_ = Kind::kNormal;
    a_ = number_of(normal, 0);
    b_ = number_of(normal, 1);
    if (b_ <= 0) {
        report.error(normal.children[1], "a standard deviation is above 0");
        return false;
    }
    const Node* within = node.find("within");
    if (within == nullptr) {
        within_low_ = -std::numeric_limits<double>::infinity();
        within_high_ = -within_low_;
        return true;
    }
    within_low_ = number_of(*within, 0);
    within_high_ = number_of(*within, 1);
    low_ = normal_part((within_low_ - a_) / b_);
    high_ = normal_part((within_high_ - a_) / b_);
    constexpr double kLeastPart = 1e-12;  // beyond that the quantiles are rounding alone
    if (high_ - low_ > kLeastPart) return true;
    report.error(*within, within_low_ < within_high_
                              ? "hardly any draw of this distribution lies within these bounds"
                              : "the first bound must be below the second");
    return false;
}

bool Draw::read_bounds(const Node& bounds, Kind kind, Report& report) {
    kind_ = kind;
    a_ = number_of(bounds, 0);
    b_ = number_of(bounds, 1);
    std::string wrong;
    if (a_ > b_) wrong = "the first bound must not be above the second";
    if (kind == Kind::kLogUniform && a_ <= 0) wrong = "the bounds of log_uniform lie above 0";
    constexpr double kExact = 9007199254740992.0;  // 2^53
    const bool whole = a_ == std::floor(a_) && b_ == std::floor(b_) && std::abs(a_) < kExact &&
                       std::abs(b_) < kExact;
    if (kind == Kind::kInteger && !whole) wrong = "the bounds of integer are whole numbers";
    if (!wrong.empty()) report.error(bounds, wrong);
    return wrong.empty();
}

bool Draw::has_ends() const { return kind_ != Kind::kNormal || std::isfinite(within_low_); }

std::int64_t Draw::levels() const {
    if (kind_ == Kind::kValues) return static_cast<std::int64_t>(values_.size());
    return kind_ == Kind::kRange ? steps_ : draws_;
}

Node Draw::made(double number) const {
    Node node;
    node.kind = Node::Kind::kScalar;
    node.source = source_;
    node.mark = mark_;
    node.text = number_text(number);
    return node;
}

Node Draw::level(std::int64_t index) const {
    if (kind_ == Kind::kValues) return values_[static_cast<std::size_t>(index)];
    if (index == 0) return made(a_);
    if (index == steps_ - 1) return made(b_);
    const double part = static_cast<double>(index) / static_cast<double>(steps_ - 1);
    // By powers of ten, which come out exactly.
    const double value = log_ ? std::pow(10, std::lerp(std::log10(a_), std::log10(b_), part))
                              : std::lerp(a_, b_, part);
    return made(rounded(value));
}

double Draw::number_at(double u) const {
    if (kind_ == Kind::kInteger) return std::min(b_, a_ + std::floor(u * (b_ - a_ + 1)));
    if (kind_ == Kind::kLogUniform) return std::clamp(a_ * std::pow(b_ / a_, u), a_, b_);
    if (kind_ == Kind::kUniform) return std::lerp(a_, b_, u);
    return std::clamp(a_ + b_ * normal_quantile(std::lerp(low_, high_, u)), within_low_,
                      within_high_);
}

Node Draw::at(double u) const {
    if (kind_ == Kind::kChoice) {
        const auto first = std::upper_bound(summed_weights_.begin(), summed_weights_.end(), u);
        const auto index = static_cast<std::size_t>(first - summed_weights_.begin());
        return values_[std::min(index, values_.size() - 1)];
    }
    if (is_random()) return made(number_at(u));
    const auto index = static_cast<std::int64_t>(u * static_cast<double>(levels()));
    return level(std::min(index, levels() - 1));
}

std::string flow_text(const Node& node) {
    std::string text;
    if (node.kind == Node::Kind::kNull) return "null";
    if (node.kind == Node::Kind::kScalar) {
        const bool text_like = resolve_scalar(node.text, node.quoted).kind == Scalar::Kind::kText;
        // JSON's texts are YAML's. A name needs no quotes, unless YAML takes it for something else.
        const bool plain =
            !text_like || (!node.quoted && is_name(node.text) && node.text != "null" &&
                           node.text != "Null" && node.text != "NULL");
        return plain ? node.text : nlohmann::json(node.text).dump();
    }
    for (const Node& child : node.children) {
        if (!text.empty()) text += ", ";
        if (node.kind == Node::Kind::kMap) text += child.key + ": ";
        text += flow_text(child);
    }
    return node.kind == Node::Kind::kMap ? "{" + text + "}" : "[" + text + "]";
}

}  // namespace carom
