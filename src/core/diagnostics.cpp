#include "core/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "core/excerpt.h"
#include "core/readable.h"

namespace carom {

std::string Diagnostic::text() const {
    std::string place = readable(file);
    if (mark.line > 0) place += fmt::format(":{}", mark.line);
    if (mark.line > 0 && mark.column > 0) place += fmt::format(":{}", mark.column);
    const char* word = severity == Severity::kError ? "error" : "warning";
    return fmt::format("{}: {}: {}", place, word, readable_message(message));
}

std::string Diagnostic::shown() const { return text() + "\n" + excerpt(source_line, mark); }

bool Diagnostics::has_errors() const {
    return std::any_of(items_.begin(), items_.end(),
                       [](const Diagnostic& d) { return d.severity == Severity::kError; });
}

void Diagnostics::sort() {
    std::stable_sort(items_.begin(), items_.end(), [](const Diagnostic& a, const Diagnostic& b) {
        return std::tie(a.file, a.mark.line, a.mark.column) <
               std::tie(b.file, b.mark.line, b.mark.column);
    });
}

namespace {

/// Edit distance with neighbouring letters swapped counted once (optimal string alignment).
std::size_t edit_distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replace = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, replace});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
        std::swap(before, last);
        std::swap(last, row);
    }
    return last[b.size()];
}

}  // namespace

std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates) {
    std::string best;
    std::size_t best_distance = std::max<std::size_t>(1, word.size() / 3) + 1;
    for (const std::string& candidate : candidates) {
        const std::size_t distance = edit_distance(word, candidate);
        if (distance < best_distance) {
            best_distance = distance;
            best = candidate;
        }
    }
    return best;
}

}  // namespace carom
