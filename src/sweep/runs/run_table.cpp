#include "sweep/runs/run_table.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/failure.h"
#include "core/readable.h"

namespace carom {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string whole(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream)
        throw Failure(FailureKind::kInput,
                      fmt::format("{}: cannot be read; `carom sweep ... --index` writes it",
                                  readable(path.string())));
    return text.str();
}

/// RFC 4180, with ends of line of either kind.
class CsvReader {
  public:
    explicit CsvReader(std::string_view text) : text_(text) {}

    bool done() const { return at_ >= text_.size(); }
    int line() const { return line_; }

    std::vector<std::string> row() {
        std::vector<std::string> cells(1);
        bool quoted = false;
        for (; !done(); ++at_) {
            const char c = text_[at_];
            line_ += c == '\n' ? 1 : 0;
            if (quoted) {
                if (c != '"')
                    cells.back() += c;
                else if (at_ + 1 < text_.size() && text_[at_ + 1] == '"')
                    cells.back() += text_[++at_];
                else
                    quoted = false;
            } else if (c == '"') {
                quoted = true;
            } else if (c == ',') {
                cells.emplace_back();
            } else if (c == '\n') {
                ++at_;
                return cells;
            } else if (c != '\r') {
                cells.back() += c;
            }
        }
        return cells;
    }

  private:
    std::string_view text_;
    std::size_t at_ = 0;
    int line_ = 1;
};

void read_dataset(const fs::path& path, RunTable& table) {
    const std::string text = whole(path);
    try {
        const Json dataset = Json::parse(text);
        table.axes = dataset.at("axes").size();
        table.results = dataset.at("results").size();
        for (const char* name : {"runs", "done", "failed", "missing"})
            table.counts.emplace_back(name, dataset.at(name).dump());
        table.seed = dataset.at("seed").dump();
        table.fingerprint = dataset.at("sweep_fingerprint").get<std::string>();
        table.motion_hash = dataset.at("motion_hash").get<std::string>();
        for (const auto& [name, version] : dataset.at("versions").items())
            table.versions.emplace_back(name, version.get<std::string>());
    } catch (const Json::exception& error) {
        throw Failure(FailureKind::kInput,
                      fmt::format("{}: not as this version of carom writes it ({}); `carom sweep "
                                  "... --index` writes it anew",
                                  readable(path.string()), readable(error.what())));
    }
}

void read_index(const fs::path& path, RunTable& table) {
    const std::string text = whole(path);
    CsvReader reader(text);
    table.columns = reader.row();
    if (table.columns.size() != table.axes + table.results + 4)
        throw Failure(
            FailureKind::kInput,
            fmt::format("{}: {} columns where dataset.json has {} axes and {} results: "
                        "they are of two sweeps",
                        readable(path.string()), table.columns.size(), table.axes, table.results));
    while (!reader.done()) {
        const int line = reader.line();
        table.rows.push_back(reader.row());
        if (table.rows.back().size() != table.columns.size())
            throw Failure(
                FailureKind::kInput,
                fmt::format("{}:{}: {} cells in a table of {} columns", readable(path.string()),
                            line, table.rows.back().size(), table.columns.size()));
    }
}

}  // namespace

bool is_sweep_folder(const std::string& path) {
    std::error_code unreadable;
    return fs::exists(fs::path(path) / "dataset.json", unreadable) &&
           fs::exists(fs::path(path) / "index.csv", unreadable);
}

RunTable read_run_table(const std::string& folder) {
    RunTable table;
    table.folder = folder;
    read_dataset(fs::path(folder) / "dataset.json", table);
    read_index(fs::path(folder) / "index.csv", table);
    return table;
}

}  // namespace carom
