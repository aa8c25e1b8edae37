// Films and frames.
#pragma once

#include <carom/second_run.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

CAROM_NAMESPACE_BEGIN

/// What is left out is as `carom render` has it (docs/films.md).
struct FilmOptions {
    std::string codec{};
    std::string quality{};  ///< draft, medium, high
    std::optional<int> crf{};
    int threads = 0;                    ///< of the encoder; 0: one per processor
    bool overwrite = false;             ///< else a file that exists is an Error
    std::optional<Against> against{};   ///< else what the scene names, if it does
    std::vector<std::string> layers{};  ///< files beside PNG frames, by name (layers.h)
};

/// Draws all frames into `path`: a film by its extension (.mp4, .mkv, .webm, .gif ...), or PNGs
/// for a name with %05d or a folder. The same bytes as `carom render`. A film appears under its
/// name when it is whole; of stopped work nothing is left but finished PNGs. Returns the number
/// of frames. Throws Error, Stopped.
CAROM_API std::int64_t film(const Scene& scene, const Motion& motion, const std::string& path,
                            const FilmOptions& options = {}, const Control& control = {});

CAROM_NAMESPACE_END
