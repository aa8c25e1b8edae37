#include "sweep/runs/index.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/checksum.h"
#include "core/in_parallel.h"
#include "media/output_file.h"

namespace carom {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// RFC 4180: quotes where a field has a comma, a quote or an end of line in it.
std::string field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

std::string header(const Sweep& sweep) {
    std::string row = "run";
    for (const SweepAxis& axis : sweep.axes) row += "," + field(axis.path);
    for (const ResultSpec& result : sweep.results) row += "," + field(result.name);
    return row + ",motion_hash,status,reason\n";
}

std::string index_row(const Sweep& sweep, const std::vector<Node>& values,
                      const RunRecord& record) {
    std::string row = fmt::format("{}", record.run);
    for (const Node& value : values) row += "," + field(flow_text(value));
    for (std::size_t i = 0; i < sweep.results.size(); ++i) {
        const bool there = i < record.results.size() && record.results[i];
        row += there ? fmt::format(",{}", *record.results[i]) : ",";
    }
    return row + fmt::format(",{},{},{}\n", record.motion_hash, run_status_name(record.status),
                             field(record.reason));
}

/// Leaves a file alone that says the same already.
void write_changed(const fs::path& path, const std::string& text) {
    std::ifstream stream(path, std::ios::binary);
    std::ostringstream before;
    before << stream.rdbuf();
    if (stream.is_open() && before.str() == text) return;
    write_text_file(path.string(), text);
}

struct Row {
    RunRecord record;
    std::string text;
};

/// Of the runs first ... last - 1.
std::vector<Row> read_rows(const Sweep& sweep, const Plan& plan, const std::string& dir,
                           std::int64_t first, std::int64_t last) {
    std::vector<Row> rows(static_cast<std::size_t>(last - first));
    constexpr std::int64_t kPart = 128;  // worth handing to a thread
    in_parallel(static_cast<int>((last - first + kPart - 1) / kPart), [&](int part) {
        const std::int64_t begin = first + part * kPart;
        for (std::int64_t run = begin; run < std::min(begin + kPart, last); ++run) {
            const std::vector<Node> values = plan.values(run);
            RunRecord record = read_record(sweep, dir, run);
            if (record.fingerprint != run_fingerprint(sweep, run, values)) {
                record = {};
                record.run = run;
            }
            std::string text = index_row(sweep, values, record);
            rows[static_cast<std::size_t>(run - first)] = {std::move(record), std::move(text)};
        }
    });
    return rows;
}

/// Visits them in order; they are read by all processors, a block at a time.
void visit_rows(const Sweep& sweep, const Plan& plan, const std::string& dir, std::int64_t first,
                std::int64_t last, const std::function<void(const Row&)>& visit) {
    constexpr std::int64_t kBlock = 4096;
    for (; first < last; first += kBlock)
        for (const Row& row : read_rows(sweep, plan, dir, first, std::min(first + kBlock, last)))
            visit(row);
}

void count(const RunRecord& record, IndexCounts& counts) {
    constexpr std::size_t kMostNamed = 10;
    if (record.status == RunStatus::kDone) {
        ++counts.done;
    } else if (record.status == RunStatus::kMissing) {
        ++counts.missing;
    } else {
        ++counts.failed;
        if (counts.first_failed.size() < kMostNamed) counts.first_failed.push_back(record);
    }
}

/// Sums over the runs that are done, in their order.
struct Sums {
    Checksum motions, files;
    std::int64_t bytes = 0, count = 0;

    void add(const RunRecord& record) {
        motions.add(record.motion_hash.data(), record.motion_hash.size());
        for (const auto& [name, file] : record.files) {
            files.add(name.c_str(), name.size() + 1);
            files.add(file.checksum.data(), file.checksum.size());
            bytes += file.bytes;
            ++count;
        }
    }
};

}  // namespace

IndexCounts count_runs(const Sweep& sweep, const Plan& plan, const std::string& dir,
                       std::int64_t first, std::int64_t last) {
    IndexCounts counts;
    visit_rows(sweep, plan, dir, first, last, [&](const Row& row) { count(row.record, counts); });
    return counts;
}

IndexCounts write_index(const Sweep& sweep, const Plan& plan, const std::string& dir,
                        const std::map<std::string, std::string>& versions) {
    IndexCounts counts;
    Sums sums;
    std::string index = header(sweep);
    visit_rows(sweep, plan, dir, 0, plan.count(), [&](const Row& row) {
        index += row.text;
        count(row.record, counts);
        if (row.record.status == RunStatus::kDone) sums.add(row.record);
    });
    Json axes = Json::array(), results = Json::array();
    for (const SweepAxis& axis : sweep.axes) axes.push_back(axis.path);
    for (const ResultSpec& result : sweep.results) results.push_back(result.name);
    Json dataset = {{"carom", 1},
                    {"seed", sweep.seed},
                    {"axes", axes},
                    {"results", results},
                    {"runs", plan.count()},
                    {"done", counts.done},
                    {"failed", counts.failed},
                    {"missing", counts.missing},
                    {"sweep_fingerprint", fmt::format("{:016x}", sweep.file_fingerprint)},
                    {"base_fingerprint", fmt::format("{:016x}", fingerprint(sweep.base))},
                    {"motion_hash", fmt::format("{:016x}", sums.motions.value())},
                    {"files",
                     {{"count", sums.count},
                      {"bytes", sums.bytes},
                      {"checksum", fmt::format("{:016x}", sums.files.value())}}},
                    {"index_checksum", checksum_text(index)},
                    {"checksums", "XXH3; of a run's files: runs/*/*/run.json"},
                    {"versions", versions}};
    write_changed(fs::path(dir) / "dataset.json", dataset.dump(2) + "\n");
    write_changed(fs::path(dir) / "index.csv", index);
    return counts;
}

}  // namespace carom
