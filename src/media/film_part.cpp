#include "media/film_part.h"

#include <fmt/format.h>

#include <cinttypes>
#include <cstdio>

namespace carom {

namespace {

constexpr const char* kBefore = ", frames ";

}  // namespace

std::string FilmPart::text() const {
    return fmt::format("{}{}{}-{} of {} at {}/{}, {}", origin, kBefore, first, last, count,
                       fps_numerator, fps_denominator, settings);
}

std::optional<FilmPart> read_film_part(const std::string& comment) {
    const std::size_t at = comment.rfind(kBefore);
    if (at == std::string::npos) return std::nullopt;
    FilmPart part;
    int read = 0;
    const std::string rest = comment.substr(at);
    const int found = std::sscanf(
        rest.c_str(), ", frames %" SCNd64 "-%" SCNd64 " of %" SCNd64 " at %d/%d, %n", &part.first,
        &part.last, &part.count, &part.fps_numerator, &part.fps_denominator, &read);
    const bool sound = found == 5 && read > 0 && part.first >= 0 && part.first <= part.last &&
                       part.last < part.count && part.fps_numerator > 0 && part.fps_denominator > 0;
    if (!sound) return std::nullopt;
    part.origin = comment.substr(0, at);
    part.settings = rest.substr(static_cast<std::size_t>(read));
    return part;
}

}  // namespace carom
