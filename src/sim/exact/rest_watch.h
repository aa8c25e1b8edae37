// Who rests, and what the others do.
#pragma once

#include <cstddef>
#include <string>

#include "sim/world/exact_world.h"
#include "sim/world/links.h"

namespace carom {

class RestWatch {
  public:
    RestWatch(const ExactWorld& world, const Links& links) : world_(world), links_(links) {}

    bool all_at_rest();
    /// All that does not rest at the `end` [s], for people.
    std::string unrest(double end) const;

  private:
    bool at_rest(int ball) const;
    std::string doing(int ball) const;

    const ExactWorld& world_;
    const Links& links_;
    std::size_t awake_ = 0;  ///< a ball that was not at rest when last looked at
};

}  // namespace carom
