// What a run leaves behind: its folder, and in it run.json, which says what became of it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/document.h"
#include "sweep/file/plan.h"
#include "sweep/file/sweep_file.h"

namespace carom {

enum class RunStatus {
    kDone,
    kInvalid,  ///< no scene with these values: so it will be next time
    kFailed,   ///< tried again next time
    kMissing,  ///< there is no such run yet
};
const char* run_status_name(RunStatus status);

struct RunFile {
    std::int64_t bytes = 0;
    std::string checksum;  ///< checksum_text()
    bool operator==(const RunFile&) const = default;
};

struct RunRecord {
    std::int64_t run = 0;
    RunStatus status = RunStatus::kMissing;
    std::string reason;       ///< "" where it is done
    std::string fingerprint;  ///< run_fingerprint()
    std::string motion_hash;  ///< "" where there is no motion
    std::vector<std::optional<double>> results;
    std::map<std::string, RunFile> files;  ///< by path in the folder, run.json not among them
};

/// "runs/000/000012" below the sweep's folder: by the number alone.
std::string run_folder(std::int64_t run);
/// What tells whether a run would come out otherwise: all that is shared, its values, and its
/// number where something is drawn by it.
std::string run_fingerprint(const Sweep& sweep, std::int64_t run, const std::vector<Node>& values);

std::string record_json(const Sweep& sweep, const std::vector<Node>& values,
                        const RunRecord& record);
/// Of the run's folder below `dir`; kMissing where there is none that can be read.
RunRecord read_record(const Sweep& sweep, const std::string& dir, std::int64_t run);

/// True where the run need not be made again: done or invalid with this fingerprint, and all files
/// are there with their sizes.
bool is_settled(const RunRecord& record, const std::string& dir, const std::string& fingerprint);

/// A name beside the run's folder, of this process on this host alone.
std::string temporary_run_folder(const std::string& dir, std::int64_t run);

/// The runs of first ... last - 1 that have a folder below `dir`. Removes what killed processes
/// have left of others: temporary folders of processes of this host that are no more, and of other
/// hosts.
std::vector<bool> find_run_folders(const std::string& dir, std::int64_t first, std::int64_t last);
/// The same of a process of this host that has ended.
void remove_leftover(const std::string& dir, std::int64_t run, int process);

}  // namespace carom
