// From `-o` names to the sinks that frames go to.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "cli/distinct_files.h"
#include "media/frame_sink.h"
#include "scene/frame_ranges.h"
#include "scene/scene.h"

namespace carom {

/// How films are encoded; PNG frames are not touched by it.
struct EncodingOptions {
    std::string quality = "medium";  ///< draft | medium | high: sets crf and preset
    int crf = -1;                    ///< -1: as the quality says
    std::string preset;              ///< empty: as the quality says
    int threads = 0;                 ///< 0: as many as there are processors
    Existing existing = Existing::kKeep;
};

/// One `-o`.
struct OutputRequest {
    std::string path;    ///< "-" is standard output
    std::string format;  ///< for "-" only: png, or the extension of a film

    bool is_film() const;
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

/// Refuses a format without alpha for a scene with a transparent background.
void check_transparency(const std::vector<OutputRequest>& outputs, const Scene& scene);

/// Refuses what no film can have, before simulating: an odd size, a frame rate beyond the
/// container.
void check_films(const std::vector<OutputRequest>& outputs, const Scene& scene,
                 const EncodingOptions& encoding);

/// Opens a sink that works on a thread of its own.
std::unique_ptr<FrameSink> open_output(const OutputRequest& output, const Scene& scene,
                                       const EncodingOptions& encoding);

}  // namespace carom
