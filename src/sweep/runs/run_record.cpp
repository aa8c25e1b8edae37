#include "sweep/runs/run_record.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/checksum.h"
#include "scene/scalar.h"

namespace carom {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::int64_t kRunsInGroup = 1000;
constexpr const char* kRecordName = "run.json";
constexpr std::array kStatusNames = {"done", "invalid", "failed", "missing"};

std::string group_folder(std::int64_t group) { return fmt::format("runs/{:03}", group); }
std::string run_name(std::int64_t run) { return fmt::format("{:06}", run); }

std::string host_name() {
    std::array<char, 256> name{};
    if (gethostname(name.data(), name.size() - 1) != 0) return "unknown";
    return name.data();
}

std::string temporary_name(std::int64_t run, int process) {
    return fmt::format(".{}.tmp-{}-{}", run_name(run), host_name(), process);
}

Json node_json(const Node& node) {
    if (node.kind == Node::Kind::kNull) return nullptr;
    if (node.kind == Node::Kind::kScalar) {
        const Scalar scalar = resolve_scalar(node.text, node.quoted);
        if (scalar.kind == Scalar::Kind::kNumber) return scalar.number;
        if (scalar.kind == Scalar::Kind::kBool) return scalar.boolean;
        return node.text;
    }
    const bool map = node.kind == Node::Kind::kMap;
    Json json = map ? Json::object() : Json::array();
    for (const Node& child : node.children) {
        if (map)
            json[child.key] = node_json(child);
        else
            json.push_back(node_json(child));
    }
    return json;
}

std::optional<std::int64_t> number_of(std::string_view text) {
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || number < 0) return std::nullopt;
    return number;
}

/// Whether a process of this program goes on: its number alone may be another's by now, or that of
/// one that has ended and nobody has asked how.
bool is_running(std::int64_t process) {
    std::error_code error;
    const fs::path ours = fs::read_symlink("/proc/self/exe", error);
    const fs::path its = fs::read_symlink(fmt::format("/proc/{}/exe", process), error);
    return !error && its.filename().string().starts_with(ours.filename().string());
}

/// A process that is gone cannot go on with its folder. What another host has left is from a task
/// that was put back into the queue.
bool is_leftover(std::string_view name) {
    const std::size_t dash = name.rfind('-');
    const std::optional<std::int64_t> process = number_of(name.substr(dash + 1));
    if (!process) return false;
    if (name.find(".tmp-" + host_name() + "-") == name.npos) return true;
    return !is_running(*process);
}

void read_results(const Sweep& sweep, const Json& json, RunRecord& record) {
    for (const ResultSpec& spec : sweep.results) {
        const auto found = json.find(spec.name);
        const bool there = found != json.end() && found->is_number();
        record.results.push_back(there ? std::optional(found->get<double>()) : std::nullopt);
    }
}

}  // namespace

const char* run_status_name(RunStatus status) {
    return kStatusNames[static_cast<std::size_t>(status)];
}

std::string run_folder(std::int64_t run) {
    return group_folder(run / kRunsInGroup) + "/" + run_name(run);
}

std::string temporary_run_folder(const std::string& dir, std::int64_t run) {
    return (fs::path(dir) / group_folder(run / kRunsInGroup) / temporary_name(run, ::getpid()))
        .string();
}

std::string run_fingerprint(const Sweep& sweep, std::int64_t run, const std::vector<Node>& values) {
    Checksum sum;
    const auto add = [&sum](const std::string& text) { sum.add(text.c_str(), text.size() + 1); };
    sum.add(&sweep.fingerprint, sizeof sweep.fingerprint);
    for (std::size_t i = 0; i < values.size(); ++i) {
        add(sweep.axes[i].path);
        add(flow_text(values[i]));
    }
    if (!sweep.balls.empty() || sweep.camera) sum.add(&run, sizeof run);
    return fmt::format("{:016x}", sum.value());
}

std::string record_json(const Sweep& sweep, const std::vector<Node>& values,
                        const RunRecord& record) {
    Json json = {{"run", record.run},
                 {"status", run_status_name(record.status)},
                 {"reason", record.reason},
                 {"fingerprint", record.fingerprint}};
    json["parameters"] = Json::object();
    for (std::size_t i = 0; i < values.size(); ++i)
        json["parameters"][sweep.axes[i].path] = node_json(values[i]);
    json["results"] = Json::object();
    for (std::size_t i = 0; i < record.results.size(); ++i)
        json["results"][sweep.results[i].name] =
            record.results[i] ? Json(*record.results[i]) : Json(nullptr);
    json["motion_hash"] = record.motion_hash;
    json["files"] = Json::object();
    for (const auto& [name, file] : record.files)
        json["files"][name] = {{"bytes", file.bytes}, {"checksum", file.checksum}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

RunRecord read_record(const Sweep& sweep, const std::string& dir, std::int64_t run) {
    RunRecord record;
    record.run = run;
    std::ifstream stream(fs::path(dir) / run_folder(run) / kRecordName, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    const Json json = Json::parse(text.str(), nullptr, false);
    try {
        const std::string status = json.at("status").get<std::string>();
        for (std::size_t i = 0; i < kStatusNames.size(); ++i)
            if (status == kStatusNames[i]) record.status = static_cast<RunStatus>(i);
        record.reason = json.at("reason").get<std::string>();
        record.fingerprint = json.at("fingerprint").get<std::string>();
        record.motion_hash = json.at("motion_hash").get<std::string>();
        read_results(sweep, json.at("results"), record);
        for (const auto& [name, file] : json.at("files").items())
            record.files[name] = {file.at("bytes").get<std::int64_t>(),
                                  file.at("checksum").get<std::string>()};
    } catch (const Json::exception&) {
        record = {};
        record.run = run;
    }
    return record;
}

bool is_settled(const RunRecord& record, const std::string& dir, const std::string& fingerprint) {
    if (record.status != RunStatus::kDone && record.status != RunStatus::kInvalid) return false;
    if (record.fingerprint != fingerprint) return false;
    const fs::path folder = fs::path(dir) / run_folder(record.run);
    for (const auto& [name, file] : record.files) {
        std::error_code error;
        const auto size = fs::file_size(folder / name, error);
        if (error || static_cast<std::int64_t>(size) != file.bytes) return false;
    }
    return true;
}

std::vector<bool> find_run_folders(const std::string& dir, std::int64_t first, std::int64_t last) {
    std::vector<bool> found(static_cast<std::size_t>(last - first));
    if (last == first) return found;
    for (std::int64_t group = first / kRunsInGroup; group <= (last - 1) / kRunsInGroup; ++group) {
        std::error_code error;
        std::vector<fs::path> leftovers;
        for (const auto& entry :
             fs::directory_iterator(fs::path(dir) / group_folder(group), error)) {
            const std::string name = entry.path().filename().string();
            const bool hidden = name.starts_with(".");
            const std::size_t end = hidden ? name.find(".tmp-") : name.size();
            if (end == name.npos) continue;
            const std::optional<std::int64_t> run =
                number_of(std::string_view(name).substr(hidden ? 1 : 0, end - (hidden ? 1 : 0)));
            if (!run || *run < first || *run >= last) continue;
            if (!hidden)
                found[static_cast<std::size_t>(*run - first)] = name == run_name(*run);
            else if (is_leftover(name))
                leftovers.push_back(entry.path());
        }
        for (const fs::path& path : leftovers) fs::remove_all(path, error);
    }
    return found;
}

void remove_leftover(const std::string& dir, std::int64_t run, int process) {
    std::error_code ignored;
    fs::remove_all(fs::path(dir) / group_folder(run / kRunsInGroup) / temporary_name(run, process),
                   ignored);
}

}  // namespace carom
