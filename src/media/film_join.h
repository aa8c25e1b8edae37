// Parts of one film into the film, without encoding again.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "media/output_file.h"

namespace carom {

/// What goes on beside it; each may be empty.
struct JoinHooks {
    std::function<void()> check;  ///< called often; may throw to leave the work
    std::function<void(std::int64_t done, std::int64_t total)> joined;  ///< frames so far
};

/// Refuses an output whose container cannot take up parts: Failure(kInput) that names those that
/// can.
void require_joinable(const std::string& output);

/// Puts the films `parts`, in any order, one behind the other into `output`; they must be all parts
/// of one film, as `carom render --chunk` makes them (media/film_part.h), in the container of
/// `output`. Its packets are theirs, its frames shown at k/fps, as if it had been filmed in one go.
/// Returns the number of its frames.
///
/// Throws Failure(kInput), which names the files, for what is no part of a film, for parts of other
/// films, sizes, settings or versions, for frames that are missing or there twice, and for a part
/// that is not whole; Failure(kOutput) as films do.
std::int64_t join_films(const std::vector<std::string>& parts, const std::string& output,
                        Existing existing = Existing::kReplace, const JoinHooks& hooks = {});

}  // namespace carom
