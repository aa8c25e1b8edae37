// What a film will take, before it begins.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/outputs.h"

namespace carom {

/// An estimate: right to a factor of a few, for the scene decides how much moves.
struct FilmNeeds {
    std::int64_t frames = 0;
    double memory_bytes = 0;  ///< for pictures, where the program itself needs some 200 MB besides
    double disk_bytes = 0;    ///< of all outputs together; none for standard output
    double time_s = 0;        ///< on two cores
};

FilmNeeds film_needs(const std::vector<OutputRequest>& outputs, const Scene& scene,
                     const EncodingOptions& encoding, std::int64_t frames);

/// "about 12 MB on disk, 90 MB for pictures, 14 s on two cores".
std::string needs_text(const FilmNeeds& needs);

/// Refuses, with numbers and what to change, a film whose pictures do not fit into the memory that
/// is there, one that does not fit on its disk even if it takes a tenth of the estimate (what has
/// to be there whatever is drawn, of formats without compression), and one of more than 30 days:
/// Failure(kOutput) for the disk, else Failure(kInput).
void require_room(const std::vector<OutputRequest>& outputs, const Scene& scene,
                  const EncodingOptions& encoding, std::int64_t frames);

/// Bytes of memory that the process may still take: the least of what the system has free, what is
/// left of its control group's and its own limits; 0 where that cannot be told.
double free_memory_bytes();

}  // namespace carom
