// Whether the method `fixed` may have let bodies pass through one another.
#pragma once

namespace carom {

/// The effect's name in --stats. `on` where a ball moved farther than its own radius within one
/// step: as long as none does, the overlap of two balls that meet is seen at the end of some step.
inline constexpr const char* kTunnelling = "tunnelling";

}  // namespace carom
