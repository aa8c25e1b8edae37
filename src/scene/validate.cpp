#include "scene/validate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "scene/key_places.h"
#include "scene/scalar.h"

namespace carom {

namespace {

bool is_digits(std::string_view text) {
    constexpr std::size_t kMost = 9;  // fits an int
    return !text.empty() && text.size() <= kMost && text[0] != '0' &&
           text.find_first_not_of("0123456789") == std::string_view::npos;
}

bool is_fraction(std::string_view text) {
    const std::size_t slash = text.find('/');
    return slash != std::string_view::npos && is_digits(text.substr(0, slash)) &&
           is_digits(text.substr(slash + 1));
}

bool is_color(std::string_view text) {
    return (text.size() == 7 || text.size() == 4) && text[0] == '#' &&
           text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string_view::npos;
}

double fraction_value(const std::string& text) {
    const std::size_t slash = text.find('/');
    return std::stod(text.substr(0, slash)) / std::stod(text.substr(slash + 1));
}

/// "12.5", "'abc'", "a list": what stands there, for messages.
std::string found_text(const Node& node) {
    switch (node.kind) {
        case Node::Kind::kNull:
            return "empty";
        case Node::Kind::kList:
            return fmt::format("a list of {}", node.children.size());
        case Node::Kind::kMap:
            return "a mapping";
        case Node::Kind::kScalar:
            break;
    }
    const bool is_text = resolve_scalar(node.text, node.quoted).kind == Scalar::Kind::kText;
    return is_text ? "the text " + quoted_excerpt(node.text) : node.text.substr(0, 80);
}

bool in_range(double value, const Range& range) {
    if (value > range.max || value < range.min) return false;
    if (range.above_min && value == range.min) return false;
    if (range.below_max && value == range.max) return false;
    return range.multiple_of == 0 || std::fmod(value, range.multiple_of) == 0;
}

/// The bound that `value` breaks. Bounds that only keep numbers finite are not worth a word where
/// another one is meant: a mass of -1 must be above 0, not below a million tonnes.
std::string broken_bound(Range range, double value) {
    constexpr double kTechnicalMin = 1e-5, kTechnicalMax = 1e5;
    if (value >= range.min && value <= range.max && range.multiple_of == 2)
        return "an even number of";
    range.multiple_of = 0;
    if (value <= 0 && range.min > 0 && range.min < kTechnicalMin) {
        range.min = 0;
        range.above_min = true;
    }
    if (value < range.max && range.max >= kTechnicalMax)
        range.max = std::numeric_limits<double>::infinity();
    return range_text(range);
}

class Validator {
  public:
    Validator(const KeyTable& table, Report& report) : table_(table), report_(report) {}

    bool section(Node& map, Section section);

  private:
    bool value(Node& node, const KeySpec& spec);
    bool scalar(Node& node, const KeySpec& spec);
    bool list(Node& node, const KeySpec& spec);
    bool list_of_maps(Node& node, const KeySpec& spec);
    bool named_maps(Node& node, const KeySpec& spec);
    bool named_texts(Node& node);
    bool paths(Node& node, const KeySpec& spec);
    bool name_of_entry(Node& entry);
    bool number(Node& node, const KeySpec& spec, double number);
    void rule(Node& map, const Rule& rule);
    bool wrong(Node& node, std::string message);
    bool wrong_form(Node& node, const KeySpec& spec);

    const KeyTable& table_;
    Report& report_;
};

bool Validator::wrong(Node& node, std::string message) {
    report_.error(node, std::move(message));
    return node.valid = false;
}

bool Validator::wrong_form(Node& node, const KeySpec& spec) {
    if (node.kind == Node::Kind::kNull)
        return wrong(node, fmt::format("'{}' has no value; it must be {}, or left out", spec.key,
                                       expected_text(spec)));
    std::string message =
        fmt::format("'{}' must be {}, not {}", spec.key, expected_text(spec), found_text(node));
    const bool is_word = node.kind == Node::Kind::kScalar && !spec.words.empty();
    if (is_word) {
        const std::string near =
            nearest_word(node.text.substr(0, 100),
                         std::vector<std::string>(spec.words.begin(), spec.words.end()));
        if (!near.empty()) message += fmt::format("; did you mean '{}'?", near);
    }
    return wrong(node, std::move(message));
}

bool Validator::number(Node& node, const KeySpec& spec, double number) {
    if (in_range(number, spec.range)) return true;
    const std::string unit = spec.unit.empty() ? "" : fmt::format(" {}", spec.unit);
    return wrong(node, fmt::format("'{}' must be {}{}, not {}", spec.key,
                                   broken_bound(spec.range, number), unit, number_text(number)));
}

bool Validator::scalar(Node& node, const KeySpec& spec) {
    const Scalar scalar = resolve_scalar(node.text, node.quoted);
    const auto takes = [&](Forms forms) { return (spec.forms & forms) != 0; };
    switch (scalar.kind) {
        case Scalar::Kind::kNotFinite:
            if (!takes(form::kNumber | form::kInteger)) break;
            return wrong(node, fmt::format("'{}' must be a finite number, not {}", spec.key,
                                           node.text.substr(0, 80)));
        case Scalar::Kind::kNumber:
            if (takes(form::kNumber) || (takes(form::kInteger) && scalar.integral()))
                return number(node, spec, scalar.number);
            break;
        case Scalar::Kind::kBool:
            if (takes(form::kBool)) return true;
            break;
        case Scalar::Kind::kText:
            if (takes(form::kText)) return true;
            if (takes(form::kWord) &&
                std::find(spec.words.begin(), spec.words.end(), node.text) != spec.words.end())
                return true;
            if (takes(form::kColor) && is_color(node.text)) return true;
            if (takes(form::kFraction) && is_fraction(node.text))
                return number(node, spec, fraction_value(node.text));
            if (takes(form::kName | form::kReference) && is_name(node.text)) return true;
            break;
    }
    return wrong_form(node, spec);
}

bool Validator::list(Node& node, const KeySpec& spec) {
    if ((spec.forms & form::kValues) != 0 && !node.children.empty()) return true;
    const bool numbers = (spec.forms & (form::kNumbers | form::kIntegers)) != 0;
    if (!numbers && (spec.forms & (form::kReferences | form::kTexts)) == 0)
        return wrong_form(node, spec);
    if (spec.count != 0 && node.children.size() != static_cast<std::size_t>(spec.count))
        return wrong_form(node, spec);
    KeySpec entry = spec;
    entry.forms = form::kNumber;
    if ((spec.forms & form::kIntegers) != 0) entry.forms = form::kInteger;
    if ((spec.forms & form::kReferences) != 0) entry.forms = form::kReference;
    if ((spec.forms & form::kTexts) != 0) entry.forms = form::kText;
    for (Node& child : node.children) {
        const bool right =
            child.kind == Node::Kind::kScalar ? scalar(child, entry) : wrong_form(child, entry);
        node.valid = right && node.valid;
    }
    return node.valid;
}

bool Validator::list_of_maps(Node& node, const KeySpec& spec) {
    for (Node& child : node.children) {
        const bool right =
            child.kind == Node::Kind::kMap
                ? section(child, spec.child)
                : wrong(child, fmt::format("an entry of '{}' must be a mapping, not {}", spec.key,
                                           found_text(child)));
        node.valid = right && node.valid;
    }
    return node.valid;
}

/// Whether its key is a name.
bool Validator::name_of_entry(Node& entry) {
    if (is_name(entry.key)) return true;
    report_.error_at_key(
        entry, fmt::format("{} is not a name: a name is a letter or '_' and then letters, "
                           "digits, '_' or '-', at most {} characters",
                           quoted_excerpt(entry.key), kMaxNameLength));
    return entry.valid = false;
}

bool Validator::named_texts(Node& node) {
    for (Node& child : node.children) {
        bool right = name_of_entry(child);
        if (child.kind != Node::Kind::kScalar)
            right = wrong(child,
                          fmt::format("'{}' must be a text, not {}", child.key, found_text(child)));
        node.valid = right && node.valid;
    }
    return node.valid;
}

/// The paths themselves, and what stands under them, are for the scene to judge.
bool Validator::paths(Node& node, const KeySpec& spec) {
    for (Node& child : node.children) {
        bool right = true;
        if (child.kind == Node::Kind::kMap) right = section(child, spec.child);
        if (child.kind == Node::Kind::kNull)
            right = wrong(child, fmt::format("'{}' has no value", child.key));
        if (child.kind == Node::Kind::kList && child.children.empty())
            right = wrong(child, fmt::format("'{}' has no values", child.key));
        node.valid = right && node.valid;
    }
    return node.valid;
}

bool Validator::named_maps(Node& node, const KeySpec& spec) {
    for (Node& child : node.children) {
        bool right = true;
        if (!name_of_entry(child)) {
            right = false;
        } else if (child.kind != Node::Kind::kMap) {
            right = wrong(
                child, fmt::format("'{}' must be a mapping, not {}", child.key, found_text(child)));
        }
        if (child.kind == Node::Kind::kMap) right = section(child, spec.child) && right;
        node.valid = right && node.valid;
    }
    return node.valid;
}

bool Validator::value(Node& node, const KeySpec& spec) {
    const auto takes = [&](Forms forms) { return (spec.forms & forms) != 0; };
    if (node.kind == Node::Kind::kScalar) return scalar(node, spec);
    if (node.kind == Node::Kind::kMap && takes(form::kMap)) return section(node, spec.child);
    if (node.kind == Node::Kind::kMap && takes(form::kNamedMaps)) return named_maps(node, spec);
    if (node.kind == Node::Kind::kMap && takes(form::kNamedTexts)) return named_texts(node);
    if (node.kind == Node::Kind::kMap && takes(form::kPaths)) return paths(node, spec);
    if (node.kind == Node::Kind::kList && takes(form::kMaps)) return list_of_maps(node, spec);
    if (node.kind == Node::Kind::kList) return list(node, spec);
    return wrong_form(node, spec);
}

void Validator::rule(Node& map, const Rule& rule) {
    std::vector<const Node*> present;
    for (const std::string_view key : rule.keys)
        if (const Node* node = map.find(key)) present.push_back(node);
    const auto listed = [&] { return fmt::format("'{}'", fmt::join(rule.keys, "', '")); };
    if (rule.kind == Rule::Kind::kAboveZeroWith) {
        if (present.size() < 2 || !present[0]->valid || !present[1]->valid) return;
        const bool first_above = resolve_scalar(present[0]->text, false).number > 0;
        if (!first_above || resolve_scalar(present[1]->text, false).number > 0) return;
        report_.error(*present[1], fmt::format("'{}' must be above 0 where '{}' is, not {}",
                                               rule.keys[1], rule.keys[0], present[1]->text));
        map.valid = false;
        return;
    }
    const bool too_many = present.size() > 1 && rule.kind != Rule::Kind::kAtLeastOne;
    const bool too_few = present.empty() && rule.kind != Rule::Kind::kAtMostOne;
    if (too_many) {
        // The one that stands further down is the one to be taken out.
        const auto order = [](const Node* a, const Node* b) {
            return std::tie(a->source, a->key_mark.line, a->key_mark.column) <
                   std::tie(b->source, b->key_mark.line, b->key_mark.column);
        };
        std::stable_sort(present.begin(), present.end(), order);
        report_.error_at_key(*present[1], fmt::format("'{}' and '{}' cannot stand together",
                                                      present[0]->key, present[1]->key));
    }
    if (too_few)
        report_.error(
            map,
            fmt::format("{} of {} must stand here",
                        rule.kind == Rule::Kind::kExactlyOne ? "one" : "at least one", listed()));
    if (too_many || too_few) map.valid = false;
}

bool Validator::section(Node& map, Section section) {
    for (Node& child : map.children) {
        const KeySpec* spec = table_.find(section, child.key);
        if (spec == nullptr) {
            std::string message;
            if (!report_.is_full()) {
                message = fmt::format("unknown key {}", quoted_excerpt(child.key));
                message += child.key.find(':') != std::string::npos
                               ? "; a space must follow the ':'"
                               : key_suggestion(table_, section, child.key);
            }
            report_.error_at_key(child, std::move(message));
            map.valid = child.valid = false;
        } else {
            map.valid = value(child, *spec) && map.valid;
        }
    }
    for (const KeySpec* spec : table_.keys(section)) {
        if (!spec->required || map.find(spec->key) != nullptr) continue;
        wrong(map, fmt::format("the key '{}' is missing, such as '{}: {}'", spec->key, spec->key,
                               spec->example));
    }
    for (const Rule& one : table_.rules())
        if (one.section == section) rule(map, one);
    return map.valid;
}

}  // namespace

bool validate_section(Node& map, Section section, const KeyTable& table, Report& report) {
    return Validator(table, report).section(map, section);
}

std::string expected_text(const KeySpec& spec) {
    const auto takes = [&](Forms forms) { return (spec.forms & forms) != 0; };
    const std::string unit = spec.unit.empty() ? "" : fmt::format(" ({})", spec.unit);
    const std::string count = spec.count == 0 ? " of" : fmt::format(" of {}", spec.count);
    std::vector<std::string> texts;
    if (takes(form::kNumber)) texts.push_back("a number" + unit);
    if (takes(form::kInteger)) texts.push_back("a whole number" + unit);
    if (takes(form::kBool)) texts.push_back("true or false");
    if (takes(form::kText)) texts.push_back("text (in quotes if it looks like a number)");
    if (takes(form::kName))
        texts.push_back(
            fmt::format("a name: a letter or '_' and then letters, digits, '_' or '-', "
                        "at most {} characters",
                        kMaxNameLength));
    if (takes(form::kReference)) texts.push_back("a name");
    if (takes(form::kWord) && spec.words.size() == 1)
        texts.push_back(fmt::format("'{}'", spec.words.front()));
    else if (takes(form::kWord))
        texts.push_back(fmt::format("one of {}", fmt::join(spec.words, ", ")));
    if (takes(form::kColor)) texts.push_back("a colour such as \"#c8102e\", in quotes");
    if (takes(form::kFraction)) texts.push_back("a fraction such as \"30000/1001\"");
    if (takes(form::kNumbers)) texts.push_back(fmt::format("a list{} numbers{}", count, unit));
    if (takes(form::kIntegers))
        texts.push_back(fmt::format("a list{} whole numbers{}", count, unit));
    if (takes(form::kReferences)) texts.push_back(fmt::format("a list{} names", count));
    if (takes(form::kTexts)) texts.push_back("a list of texts");
    if (takes(form::kMap) || takes(form::kNamedMaps)) texts.push_back("a mapping");
    if (takes(form::kMaps)) texts.push_back("a list of mappings");
    if (takes(form::kValues)) texts.push_back("a list of values");
    if (takes(form::kNamedTexts)) texts.push_back("a mapping from names to texts");
    if (takes(form::kPaths)) texts.push_back("a mapping from paths to values");
    return fmt::format("{}", fmt::join(texts, " or "));
}

std::string range_text(const Range& range) {
    const bool low = std::isfinite(range.min), high = std::isfinite(range.max);
    std::string text;
    if (low && range.min == range.max) return number_text(range.min);
    if (low && high && range.below_max)
        return fmt::format("{} {} and below {}", range.above_min ? "above" : "at least",
                           number_text(range.min), number_text(range.max));
    if (low && high && !range.above_min)
        text = fmt::format("between {} and {}", number_text(range.min), number_text(range.max));
    else if (low && high)
        text =
            fmt::format("above {} and at most {}", number_text(range.min), number_text(range.max));
    else if (low)
        text = fmt::format("{} {}", range.above_min ? "above" : "at least", number_text(range.min));
    else if (high)
        text = fmt::format("at most {}", number_text(range.max));
    if (range.multiple_of == 2) text += text.empty() ? "even" : " and even";
    return text;
}

}  // namespace carom
