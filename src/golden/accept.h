// Taking drawn pictures of a report as the new goldens.
#pragma once

#include <string>
#include <vector>

namespace carom {

/// A drawn picture that takes the place of a golden.
struct Acceptance {
    std::string name;
    std::string drawn;   ///< path of the picture
    std::string golden;  ///< path that it will have
    std::string bytes;   ///< of the picture
    bool replaces = false;
};

/// What of the report (report_json()) at `path` is to be taken: all stills that are not the same,
/// or those among them that `only` names, by still or by scene. Throws Failure(kInput), before
/// anything is written, where the report cannot be read, a name is not in it, a drawn picture is no
/// PNG or not the one that was compared, or a golden has changed since.
std::vector<Acceptance> acceptances(const std::string& path, const std::vector<std::string>& only);

/// Writes all of them: first whole beside their places, then each renamed. Failure(kOutput).
void take(const std::vector<Acceptance>& acceptances);

}  // namespace carom
