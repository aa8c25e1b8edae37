// Where everything that reads the document leaves what it found wrong.
#pragma once

#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "scene/document.h"

namespace carom {

/// Collects diagnostics and names their places: the file, or "--set PATH" for overridden values.
class Report {
  public:
    explicit Report(std::string file) : sources_{std::move(file)} {}

    /// A further source; the number that nodes made by it carry.
    int add_source(std::string name);

    void error(const Node& at, std::string message);
    void error_at_key(const Node& at, std::string message);
    void warning(const Node& at, std::string message);
    void error_in_source(int source, SourceMark mark, std::string message);

    /// True where further mistakes are not listed: their words need not be made.
    bool is_full() const { return listed_ > kMostListed; }

    const std::string& file() const { return sources_.front(); }
    Diagnostics& diagnostics() { return diagnostics_; }

  private:
    /// Files made by programs can be wrong in a million places; nobody reads more than this.
    static constexpr int kMostListed = 1000;

    void add(Severity severity, int source, SourceMark mark, std::string message);

    std::vector<std::string> sources_;
    Diagnostics diagnostics_;
    int listed_ = 0;
};

/// "; did you mean 'x'?", or the candidates themselves while they are few, or nothing.
std::string suggestion(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace carom
