// How many programs draw the balls and what belongs to them.
#pragma once

namespace carom {

/// Programs that draw fast, one for each style of ball that the scene has, and others where there
/// is less to look for; or one for everything, which compiles sooner.
enum class BallPrograms { kEachStyle, kOneForAll };

}  // namespace carom
