// Makes one run of a sweep: scene, motion, files, results; its folder appears when it is whole.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "render/painter.h"
#include "scene/scene.h"
#include "sweep/file/plan.h"
#include "sweep/file/results.h"
#include "sweep/file/sweep_file.h"
#include "sweep/runs/run_record.h"

namespace carom {

/// The scene of a run, or why there is none.
struct RunScene {
    std::optional<Scene> scene;
    std::string wrong;  ///< first of its mistakes
    Node root;          ///< the document, as it was built
};
RunScene make_run_scene(const Sweep& sweep, const std::vector<Node>& values, std::int64_t run);

/// One a thread or process: it keeps what runs share, such as a context to draw with.
class RunMaker {
  public:
    /// `sweep` and `plan` must outlive it. `dir`: the sweep's folder.
    RunMaker(const Sweep& sweep, const Plan& plan, std::string dir);

    const std::string& dir() const { return dir_; }

    /// Makes the run, whatever became of it before. What goes wrong with it is in its record, but
    /// Failure(kOutput), and Stopped after a request: then nothing of it stays.
    RunRecord make(std::int64_t run, const std::stop_token& stop);

    /// Says of a run that nothing came of it, in a folder with its record alone.
    RunRecord give_up(std::int64_t run, const std::string& reason);

    struct Stopped {};

  private:
    void fill(RunRecord& record, const std::vector<Node>& values, const std::string& folder,
              const std::stop_token& stop);
    void write_record(const RunRecord& record, const std::vector<Node>& values,
                      const std::string& folder) const;

    const Sweep& sweep_;
    const Plan& plan_;
    std::string dir_;
    ResultTable results_;
    std::shared_ptr<DrawingContexts> contexts_;  ///< made when first needed
};

}  // namespace carom
