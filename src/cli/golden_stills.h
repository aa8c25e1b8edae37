// The stills of `carom golden`: every wanted instant of every scene, drawn one after the other.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cli/options.h"
#include "core/image.h"
#include "golden/still_check.h"

namespace carom {

class DrawingContexts;
class Interrupt;

struct GoldenOptions {
    std::vector<std::string> scenes;
    std::string folder;
    std::string differences;  ///< folder for pictures of what differs; empty: none
    std::vector<double> times;
    GoldenLimits limits;
    std::string html, junit, json;  ///< reports; empty: none
    bool orphans_fail = false;
    bool dry_run = false;
    CommonOptions common;
};

/// Refuses two stills under one name, of which the second would replace the first.
class GoldenNames {
  public:
    void add_scene(const std::string& scene);
    void add_time(const std::string& golden, double time);

  private:
    std::map<std::string, std::string> scenes_;  ///< stem -> path
    std::map<std::string, double> times_;        ///< path of the golden -> s
};

/// Draws stills of one scene after the other, with one driver: scenes that want the same programs
/// find them made.
class GoldenStills {
  public:
    using Use = std::function<void(const DrawnStill&, const Image&)>;

    GoldenStills(const GoldenOptions& options, const Interrupt& interrupt);

    /// Runs `use` on every wanted still of one scene. False when the scene is invalid.
    bool for_each(const std::string& scene, const Use& use);

    /// Names of all stills so far.
    const std::vector<std::string>& names() const { return done_; }

  private:
    const GoldenOptions& options_;
    const Interrupt& interrupt_;
    GoldenNames names_;
    std::shared_ptr<DrawingContexts> contexts_;
    std::vector<std::string> done_;
};

}  // namespace carom
