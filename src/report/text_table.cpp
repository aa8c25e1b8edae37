#include "report/text_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace carom {

namespace {

std::string csv_cell(const Cell& cell) {
    if (cell.is_number) return fmt::format("{}", cell.number == 0 ? 0.0 : cell.number);
    if (cell.text.find_first_of(",\"\n") == std::string::npos) return cell.text;
    std::string quoted = "\"";
    for (const char c : cell.text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + '"';
}

std::string markdown_cell(const Cell& cell) {
    if (cell.is_number) {
        const std::string digits = fmt::format("{:.{}f}", std::abs(cell.number), cell.decimals);
        const bool zero = digits.find_first_not_of("0.") == std::string::npos;
        return (cell.number < 0 && !zero ? "\u2212" : "") + digits;
    }
    std::string text;
    for (const char c : cell.text) text += c == '|' ? std::string("\\|") : std::string(1, c);
    return text;
}

}  // namespace

std::string csv_text(const TextTable& table) {
    std::string text;
    for (std::size_t i = 0; i < table.columns.size(); ++i)
        text += (i > 0 ? "," : "") + table.columns[i].name;
    text += '\n';
    for (const std::vector<Cell>& row : table.rows) {
        CAROM_CHECK(row.size(), ==, table.columns.size());
        for (std::size_t i = 0; i < row.size(); ++i) text += (i > 0 ? "," : "") + csv_cell(row[i]);
        text += '\n';
    }
    return text;
}

std::string markdown_text(const TextTable& table) {
    std::string text = "|", rule = "|";
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        text += fmt::format(" {} |", table.columns[i].heading);
        const bool numbers =
            std::any_of(table.rows.begin(), table.rows.end(),
                        [&](const std::vector<Cell>& row) { return row[i].is_number; });
        rule += numbers ? "---:|" : "---|";
    }
    text += '\n' + rule + '\n';
    for (const std::vector<Cell>& row : table.rows) {
        CAROM_CHECK(row.size(), ==, table.columns.size());
        text += '|';
        for (const Cell& cell : row) text += fmt::format(" {} |", markdown_cell(cell));
        text += '\n';
    }
    return text;
}

TextTable number_table(const std::vector<std::string>& names,
                       const std::vector<std::vector<double>>& columns) {
    CAROM_CHECK(names.size(), ==, columns.size());
    TextTable table;
    for (const std::string& name : names) table.columns.push_back({name, name});
    for (std::size_t row = 0; row < columns.front().size(); ++row) {
        std::vector<Cell> cells;
        for (const std::vector<double>& column : columns) {
            CAROM_CHECK(column.size(), ==, columns.front().size());
            cells.emplace_back(column[row], 6);
        }
        table.rows.push_back(std::move(cells));
    }
    return table;
}

}  // namespace carom
