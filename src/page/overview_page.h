// The page of `carom report` for several scenes: small pictures and plots side by side, and a table
// that sorts.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"
#include "sim/record/simulation_result.h"

namespace carom {

/// What the overview shows of one scene.
class OverviewEntry {
  public:
    /// `picture_png`: bytes, of the size of the scene's film.
    OverviewEntry(const Scene& scene, const SimulationResult& result,
                  const std::string& picture_png);

    const std::string& figure() const { return figure_; }
    const std::vector<std::string>& cells() const { return cells_; }

  private:
    std::string figure_;
    std::vector<std::string> cells_;
};

/// The whole page; equal entries give equal bytes. `version` is carom's.
std::string overview_page(const std::vector<OverviewEntry>& entries, const std::string& version);

}  // namespace carom
