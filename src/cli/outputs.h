// From `-o` names to the sinks that frames go to.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/distinct_files.h"
#include "media/film_choice.h"
#include "media/frame_sink.h"
#include "report/film_sound.h"
#include "scene/frame_ranges.h"
#include "scene/scene.h"

namespace carom {

/// How films are encoded, as asked for on the command line; PNG frames take threads and dpi.
struct EncodingOptions {
    std::optional<std::string> codec;
    std::optional<std::string> pixels;   ///< --pix-fmt
    std::optional<std::string> quality;  ///< none: medium
    std::optional<int> crf;
    std::optional<std::string> preset;
    int threads = 0;            ///< 0: as many as there are processors
    std::optional<double> dpi;  ///< of PNG frames: pixels per inch on paper
    Existing existing = Existing::kKeep;
};

/// One `-o`.
struct OutputRequest {
    std::string path;    ///< "-" is standard output
    std::string format;  ///< for "-" only: png, or the extension of a film

    bool is_film() const;
    /// Whether it is a film of a kind that holds sound.
    bool has_sound() const;
};

/// Refuses names that say no format, and two that are one: among the `-o`, `other_outputs` and
/// `inputs`. Failure(kInput), before anything is read or made.
void check_output_names(const std::vector<OutputRequest>& outputs,
                        const std::vector<NamedFile>& other_outputs,
                        const std::vector<NamedFile>& inputs);

/// Refuses what cannot be written before any work is done, such as files that exist. `frames` are
/// the ones that will be written.
void check_outputs(const std::vector<OutputRequest>& outputs, const FrameRanges& frames,
                   bool overwrite);

/// Makes the folders that frames go to, and refuses those that cannot be written into.
void prepare_folders(const std::vector<OutputRequest>& outputs);

/// Refuses what no film can have, before simulating: an option or a transparency that its codec
/// does not have, an odd size, a frame rate beyond the container, an encoder that is missing.
void check_films(const std::vector<OutputRequest>& outputs, const Scene& scene,
                 const EncodingOptions& encoding);

/// The codec and settings of one of the films; throws as check_films() does.
FilmChoice chosen_film(const OutputRequest& output, const Scene& scene,
                       const EncodingOptions& encoding);

/// What a film is made from.
struct FilmSource {
    const Scene& scene;
    const Scene* second = nullptr;  ///< of a film of two runs
    AgainstView view = AgainstView::kGhost;
    FrameRanges frames;                  ///< those that are filmed ...
    std::int64_t count = 0;              ///< ... of so many
    const FramesSound* sound = nullptr;  ///< of those; null: silence. Read while outputs are opened
};

/// What a film says of where it comes from: carom's version and the scene's fingerprint; of a part
/// of the frames also which they are and how they are encoded (media/film_part.h).
std::string origin_text(const FilmSource& source, const FilmChoice& choice);

/// What a PNG of the scene at this instant says besides its pixels.
PngNotes png_notes(const Scene& scene, double time_s, const std::optional<double>& dpi);

/// What the PNG of a frame says: the same, and of two runs the other scene's fingerprint. Nothing
/// else tells frames apart that may differ, so that those with the same notes need not be drawn
/// again.
PngNotes frame_notes(const FilmSource& source, std::int64_t frame,
                     const std::optional<double>& dpi);

/// Opens a sink that works on a thread of its own.
std::unique_ptr<FrameSink> open_output(const OutputRequest& output, const FilmSource& source,
                                       const EncodingOptions& encoding);

}  // namespace carom
