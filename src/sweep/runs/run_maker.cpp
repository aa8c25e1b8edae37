#include "sweep/runs/run_maker.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <new>
#include <sstream>
#include <utility>

#include "core/check.h"
#include "core/checksum.h"
#include "core/failure.h"
#include "core/temporaries.h"
#include "media/output_file.h"
#include "media/output_folder.h"
#include "scene/overrides.h"
#include "scene/scene_tree.h"
#include "sim/simulate.h"
#include "sweep/file/random_scene.h"
#include "sweep/runs/run_files.h"

namespace carom {

namespace {

namespace fs = std::filesystem;

/// A folder of this process's, gone with it unless it was published.
class TemporaryRunFolder {
  public:
    TemporaryRunFolder(const std::string& dir, std::int64_t run)
        : path_(temporary_run_folder(dir, run)) {
        prepare_folder(fs::path(path_).parent_path().string());
        std::error_code ignored;
        fs::remove_all(path_, ignored);
        temporaries::add([this] {
            prepare_folder(path_);
            return path_;
        });
    }
    ~TemporaryRunFolder() {
        if (path_.empty()) return;
        std::error_code ignored;
        fs::remove_all(path_, ignored);
        temporaries::forget(path_);
    }
    TemporaryRunFolder(const TemporaryRunFolder&) = delete;
    TemporaryRunFolder& operator=(const TemporaryRunFolder&) = delete;

    const std::string& path() const { return path_; }
    /// Takes the place of the folder that stands there: a process that is killed in between leaves
    /// none, or one whose record is gone or tells of something else.
    void publish_as(const fs::path& target) {
        std::error_code error;
        fs::remove(target / "run.json", error);
        fs::remove_all(target, error);
        fs::rename(path_, target, error);
        if (error)
            throw Failure(FailureKind::kOutput, fmt::format("cannot make the folder '{}': {}",
                                                            target.string(), error.message()));
        temporaries::forget(path_);
        path_.clear();
    }

  private:
    std::string path_;
};

std::string first_mistake(const Diagnostics& diagnostics) {
    int errors = 0;
    std::string first;
    for (const Diagnostic& one : diagnostics.items())
        if (one.severity == Severity::kError && errors++ == 0) first = one.text();
    return errors > 1 ? fmt::format("{} (and {} more)", first, errors - 1) : first;
}

std::map<std::string, RunFile> files_in(const std::string& folder) {
    std::map<std::string, RunFile> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        std::ifstream stream(entry.path(), std::ios::binary);
        std::ostringstream bytes;
        bytes << stream.rdbuf();
        const std::string text = bytes.str();
        files[fs::relative(entry.path(), folder).string()] = {
            static_cast<std::int64_t>(text.size()), checksum_text(text)};
    }
    return files;
}

}  // namespace

RunScene make_run_scene(const Sweep& sweep, const std::vector<Node>& values, std::int64_t run) {
    RunScene made;
    Report report(sweep.base_file);
    report.add_source(sweep.file);
    made.root = sweep.base;
    for (std::size_t i = 0; i < values.size(); ++i)
        set_value(made.root, sweep.axes[i].path, values[i], sweep.axes[i].origin, sweep.scene_keys,
                  report);
    draw_camera(sweep, run, made.root, report);
    if (!sweep.balls.empty()) {
        Node without = made.root;
        const std::optional<Scene> scene = scene_of_tree(without, sweep.scene_keys, report);
        if (scene) made.wrong = draw_balls(sweep, run, *scene, made.root, report);
    }
    const bool sound = made.wrong.empty() && !report.diagnostics().has_errors();
    // Marks of what is wrong stay out of the document.
    Node root = made.root;
    if (sound) made.scene = scene_of_tree(root, sweep.scene_keys, report);
    if (!made.scene && made.wrong.empty()) {
        report.diagnostics().sort();
        made.wrong = first_mistake(report.diagnostics());
    }
    return made;
}

RunMaker::RunMaker(const Sweep& sweep, const Plan& plan, std::string dir)
    : sweep_(sweep), plan_(plan), dir_(std::move(dir)), results_(sweep.results) {}

void RunMaker::fill(RunRecord& record, const std::vector<Node>& values, const std::string& folder,
                    const std::stop_token& stop) {
    RunScene made = make_run_scene(sweep_, values, record.run);
    record.status = RunStatus::kInvalid;
    record.reason = made.wrong;
    if (!made.scene) return;
    record.status = RunStatus::kDone;
    const SimulationResult simulated = simulate(*made.scene, stop);
    record.motion_hash = fmt::format("{:016x}", simulated.motion.hash());
    record.results = results_.evaluate(*made.scene, simulated.motion);
    if (sweep_.outputs.pictures() && !contexts_) contexts_ = make_contexts();
    write_run_files({sweep_.outputs, *made.scene, made.root, simulated}, folder, contexts_, stop);
    record.files = files_in(folder);
}

void RunMaker::write_record(const RunRecord& record, const std::vector<Node>& values,
                            const std::string& folder) const {
    write_text_file(folder + "/run.json", record_json(sweep_, values, record),
                    Durability::kUnsynced);
}

RunRecord RunMaker::make(std::int64_t run, const std::stop_token& stop) {
    const std::vector<Node> values = plan_.values(run);
    RunRecord record;
    record.run = run;
    record.fingerprint = run_fingerprint(sweep_, run, values);
    TemporaryRunFolder folder(dir_, run);
    std::string failure;
    try {
        fill(record, values, folder.path(), stop);
    } catch (const Failure& error) {
        if (error.kind() == FailureKind::kOutput) throw;
        failure = error.what();
    } catch (const Bug& error) {
        failure = fmt::format("{} (a bug in carom)", error.what());
    } catch (const std::bad_alloc&) {
        failure = "out of memory";
    }
    if (stop.stop_requested()) throw Stopped{};
    if (!failure.empty()) {
        // Half of what a run makes is of no use.
        for (const auto& entry : fs::directory_iterator(folder.path())) fs::remove_all(entry);
        record = RunRecord{run, RunStatus::kFailed, failure, record.fingerprint, "", {}, {}};
    }
    write_record(record, values, folder.path());
    folder.publish_as(fs::path(dir_) / run_folder(run));
    return record;
}

RunRecord RunMaker::give_up(std::int64_t run, const std::string& reason) {
    const std::vector<Node> values = plan_.values(run);
    const RunRecord record{
        run, RunStatus::kFailed, reason, run_fingerprint(sweep_, run, values), "", {}, {}};
    TemporaryRunFolder folder(dir_, run);
    write_record(record, values, folder.path());
    folder.publish_as(fs::path(dir_) / run_folder(run));
    return record;
}

}  // namespace carom
