// A table of numbers and words, as CSV for programs and as Markdown for people.
#pragma once

#include <string>
#include <vector>

namespace carom {

/// A word, or a number: CSV has its shortest digits that read back exactly, Markdown rounds it.
struct Cell {
    std::string text;
    bool is_number = false;
    double number = 0;
    int decimals = 0;

    Cell() = default;  ///< empty
    Cell(std::string word) : text(std::move(word)) {}
    Cell(const char* word) : text(word) {}
    Cell(std::string_view word) : text(word) {}
    Cell(double value, int markdown_decimals)
        : is_number(true), number(value), decimals(markdown_decimals) {}
};

struct Column {
    std::string name;     ///< in CSV: rebound_m
    std::string heading;  ///< in Markdown: Rebound [m]
};

struct TextTable {
    std::vector<Column> columns;
    std::vector<std::vector<Cell>> rows;  ///< each as long as `columns`
};

/// One line of names, then the rows. Words with a comma or a quote are quoted (RFC 4180).
std::string csv_text(const TextTable& table);

/// A table of GitHub's Markdown; columns of numbers are flush right.
std::string markdown_text(const TextTable& table);

/// Columns of numbers side by side; all have the same length.
TextTable number_table(const std::vector<std::string>& names,
                       const std::vector<std::vector<double>>& columns);

}  // namespace carom
