// What a motion that lasts until all rests waited for when it gave up.
#pragma once

#include <string>
#include <vector>

namespace carom {

struct UnrestedBall {
    std::string name;
    std::string does;  ///< "rolls on floor", "flies"
    double speed = 0;  ///< of its centre, m/s
    double slip = 0;   ///< radius times spin, m/s: told where the speed is 0
};

/// One line for people; `seconds` is the scene's max_duration. Empty if nothing moves.
std::string unrest_text(const std::vector<UnrestedBall>& balls, double seconds);

}  // namespace carom
