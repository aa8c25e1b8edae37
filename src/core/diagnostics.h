// The user's mistakes, as values: collected, sorted and printed together.
#pragma once

#include <string>
#include <vector>

namespace carom {

enum class Severity { kWarning, kError };

/// Where something stands in a file. Lines and columns count from 1; 0 means unknown.
struct SourceMark {
    int line = 0;
    int column = 0;
};

/// One mistake: `file:line:column: error: message`, with a second sentence that says what is right.
struct Diagnostic {
    Severity severity = Severity::kError;
    std::string file;  ///< as the user named it; "--set PATH" for a command line override
    SourceMark mark;
    std::string message;
    std::string source_line{};  ///< the line that `mark` names, without its end; "" where unknown

    /// "file:line:column: error: message", without the numbers that are unknown.
    std::string text() const;
    /// The same with an end, and below it the line with a mark under the place (excerpt.h).
    std::string shown() const;
};

/// A growing list of diagnostics. Order: as found; sort() orders by file, line, column.
class Diagnostics {
  public:
    void add(Diagnostic diagnostic) { items_.push_back(std::move(diagnostic)); }
    bool has_errors() const;
    bool empty() const { return items_.empty(); }
    const std::vector<Diagnostic>& items() const { return items_; }
    void sort();

  private:
    std::vector<Diagnostic> items_;
};

/// The candidate nearest to `word` (edit distance at most about a third of its length), or "".
std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace carom
