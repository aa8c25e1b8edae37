#include "scene/report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace carom {

int Report::add_source(std::string name) {
    sources_.push_back(std::move(name));
    return static_cast<int>(sources_.size()) - 1;
}

void Report::error(const Node& at, std::string message) {
    add(Severity::kError, at.source, at.mark, std::move(message));
}

void Report::error_at_key(const Node& at, std::string message) {
    add(Severity::kError, at.source, at.key_mark, std::move(message));
}

void Report::warning(const Node& at, std::string message) {
    add(Severity::kWarning, at.source, at.mark, std::move(message));
}

void Report::error_in_source(int source, SourceMark mark, std::string message) {
    add(Severity::kError, source, mark, std::move(message));
}

void Report::add(Severity severity, int source, SourceMark mark, std::string message) {
    if (++listed_ > kMostListed + 1) return;
    if (listed_ == kMostListed + 1) {
        mark = {};
        source = 0;
        message = fmt::format("more than {} mistakes; the rest is not listed", kMostListed);
        severity = Severity::kError;
    }
    diagnostics_.add(
        {severity, sources_[static_cast<std::size_t>(source)], mark, std::move(message)});
}

std::string suggestion(const std::string& word, const std::vector<std::string>& candidates) {
    constexpr std::size_t kMostCompared = 1000;  // bounds the work on hostile files
    constexpr std::size_t kMostListed = 14;
    if (candidates.empty() || candidates.size() > kMostCompared) return "";
    const bool comparable = word.size() <= 100;
    const std::string nearest = comparable ? nearest_word(word, candidates) : "";
    if (!nearest.empty()) return fmt::format("; did you mean '{}'?", nearest);
    if (candidates.size() > kMostListed) return "";
    return fmt::format("; known here: {}", fmt::join(candidates, ", "));
}

}  // namespace carom
