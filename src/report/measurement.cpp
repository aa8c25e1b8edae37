#include "report/measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string_view>

#include "core/failure.h"

namespace carom {

namespace {

/// value * multiplier / divisor is the nearest double: 180 cm is the double 1.8.
struct Unit {
    std::string_view name;
    Quantity quantity;
    double multiplier;
    double divisor;
    double in_si(double value) const { return value * multiplier / divisor; }
};
constexpr std::array kUnits = {
    Unit{"m", Quantity::kLength, 1, 1},         Unit{"cm", Quantity::kLength, 1, 100},
    Unit{"mm", Quantity::kLength, 1, 1000},     Unit{"in", Quantity::kLength, 254, 10000},
    Unit{"ft", Quantity::kLength, 3048, 10000}, Unit{"s", Quantity::kTime, 1, 1},
    Unit{"ms", Quantity::kTime, 1, 1000}};

[[noreturn]] void fail(const std::string& where, const std::string& message) {
    throw Failure(FailureKind::kInput, where + ": " + message);
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r";
    const std::size_t first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

const char* units_of(Quantity quantity) {
    return quantity == Quantity::kLength ? "m, cm, mm, in or ft" : "s or ms";
}

const Unit& unit_of(std::string_view unit, Quantity quantity, const std::string& where) {
    for (const Unit& known : kUnits)
        if (known.name == unit && known.quantity == quantity) return known;
    fail(where, fmt::format("'{}' is no unit of a {}; there are {}", unit,
                            quantity == Quantity::kLength ? "length" : "time", units_of(quantity)));
}

/// The number at the front of `text`, which is left with the rest.
double number_in(std::string_view& text, const std::string& where) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || !std::isfinite(value))
        fail(where, fmt::format("'{}' is no number", text.substr(0, 80)));
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return value;
}

std::vector<std::string_view> cells_of(std::string_view line, char separator) {
    std::vector<std::string_view> cells;
    for (std::size_t at = 0;;) {
        const std::size_t end = line.find(separator, at);
        cells.push_back(trimmed(line.substr(at, end - at)));
        if (end == std::string_view::npos) return cells;
        at = end + 1;
    }
}

enum class Kind { kDrop, kRebound, kInterval };
struct MeasuredColumn {
    Kind kind;
    Unit unit;
};

/// "drop [cm]", "drop (cm)" or "drop_cm".
MeasuredColumn column_of(std::string_view heading, const std::string& where) {
    std::string text(heading);
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const std::size_t name_end = text.find_first_of("_[( ");
    const std::string name = text.substr(0, name_end);
    Kind kind{};
    if (name == "drop")
        kind = Kind::kDrop;
    else if (name == "rebound")
        kind = Kind::kRebound;
    else if (name == "interval")
        kind = Kind::kInterval;
    else
        fail(where, fmt::format("unknown column '{}'; the columns are drop and rebound, or "
                                "interval, each with its unit, such as 'drop [m]'",
                                heading));
    std::string unit;
    if (name_end != std::string::npos)
        for (const char c : text.substr(name_end))
            if (std::string_view("_[]() ").find(c) == std::string_view::npos) unit += c;
    const Quantity quantity = kind == Kind::kInterval ? Quantity::kTime : Quantity::kLength;
    if (unit.empty())
        fail(where, fmt::format("the column '{}' has no unit; write '{} [{}]' ({})", heading, name,
                                quantity == Quantity::kTime ? "s" : "m", units_of(quantity)));
    return {kind, unit_of(unit, quantity, where)};
}

char separator_of(const std::string& header) {
    for (const char separator : {'\t', ';'})
        if (header.find(separator) != std::string::npos) return separator;
    return ',';
}

/// One line without its end, false behind the last. Lines that no measurement has are refused
/// before they fill the memory.
bool next_line(std::istream& file, std::string& line, const std::string& where) {
    constexpr std::size_t kLongest = 100'000;  // bytes
    line.clear();
    std::streambuf* bytes = file.rdbuf();
    for (int c = bytes->sbumpc(); c != std::char_traits<char>::eof(); c = bytes->sbumpc()) {
        if (c == '\n') return true;
        if (line.size() == kLongest)
            fail(where, fmt::format("the line has more than {} characters", kLongest));
        line += static_cast<char>(c);
    }
    return !line.empty();
}

class CsvReader {
  public:
    explicit CsvReader(std::string path) : path_(std::move(path)) {}

    Measurements read() {
        std::ifstream file(path_);
        if (!file) fail(path_, "no such file, or it cannot be read");
        constexpr int kMostLines = 1'000'000;
        for (std::string line; next_line(file, line, fmt::format("{}:{}", path_, number_ + 1));) {
            if (++number_ > kMostLines)
                fail(path_, fmt::format("the file has more than {} lines", kMostLines));
            if (number_ == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
            const std::string_view text = trimmed(line);
            if (text.empty() || text.front() == '#') continue;
            if (columns_.empty())
                header(std::string(text));
            else
                row(text);
        }
        if (file.bad()) fail(path_, "reading failed");
        if (columns_.empty()) fail(path_, "the file is empty");
        if (result_.drops.empty() && result_.intervals_s.empty())
            fail(path_, "there is no measurement below the header");
        return std::move(result_);
    }

  private:
    std::string where() const { return fmt::format("{}:{}", path_, number_); }
    bool has(Kind kind) const {
        return std::any_of(columns_.begin(), columns_.end(),
                           [&](const MeasuredColumn& c) { return c.kind == kind; });
    }

    void header(const std::string& line) {
        separator_ = separator_of(line);
        for (const std::string_view cell : cells_of(line, separator_)) {
            const MeasuredColumn column = column_of(cell, where());
            if (has(column.kind)) fail(where(), fmt::format("the column '{}' stands twice", cell));
            columns_.push_back(column);
        }
        if (has(Kind::kInterval) ? columns_.size() != 1 : columns_.size() != 2)
            fail(where(), "there must be the columns drop and rebound, or the column interval");
    }

    void row(std::string_view line) {
        const std::vector<std::string_view> cells = cells_of(line, separator_);
        if (cells.size() != columns_.size())
            fail(where(), fmt::format("{} values under {} columns", cells.size(), columns_.size()));
        MeasuredDrop drop{0, 0, where()};
        for (std::size_t i = 0; i < cells.size(); ++i) {
            std::string_view rest = cells[i];
            const double value = columns_[i].unit.in_si(number_in(rest, where()));
            if (!rest.empty())
                fail(where(), fmt::format("'{}' is no number (units stand in the header)",
                                          cells[i].substr(0, 80)));
            if (columns_[i].kind == Kind::kDrop) drop.drop_m = value;
            if (columns_[i].kind == Kind::kRebound) drop.rebound_m = value;
            if (columns_[i].kind == Kind::kInterval) result_.intervals_s.push_back(value);
        }
        if (!has(Kind::kInterval)) result_.drops.push_back(std::move(drop));
    }

    std::string path_;
    int number_ = 0;
    char separator_ = ',';
    std::vector<MeasuredColumn> columns_;
    Measurements result_;
};

}  // namespace

double parse_quantity(const std::string& text, Quantity quantity, const std::string& where) {
    std::string_view rest = trimmed(text);
    const double value = number_in(rest, where);
    rest = trimmed(rest);
    return rest.empty() ? value : unit_of(rest, quantity, where).in_si(value);
}

Measurements read_measurements(const std::string& path) { return CsvReader(path).read(); }

}  // namespace carom
