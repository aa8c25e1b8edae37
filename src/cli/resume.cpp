#include "cli/resume.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/failure.h"
#include "media/output_file.h"
#include "media/png.h"

namespace carom {

void require_resumable(const std::vector<OutputRequest>& outputs) {
    for (const OutputRequest& output : outputs)
        if (output.is_film() || output.path == "-")
            throw Failure(
                FailureKind::kInput,
                fmt::format("--resume is for PNG frames in files, which {} is not: a film is "
                            "written in one go; to be able to go on, film parts with "
                            "--chunk I/N and put them together with `carom join`",
                            output.path == "-" ? "standard output" : "'" + output.path + "'"));
}

FrameRanges missing_frames(const std::vector<OutputRequest>& outputs, const FilmSource& source,
                           const EncodingOptions& encoding, const Interrupt& interrupt) {
    const Film& film = source.scene.film;
    std::vector<FrameRange> missing;
    for (const std::int64_t frame : source.frames) {
        interrupt.check();
        const PngNotes notes = frame_notes(source, frame, encoding.dpi);
        const bool is_there =
            std::all_of(outputs.begin(), outputs.end(), [&](const OutputRequest& output) {
                return is_whole_png(sequence_path(output.path, frame), film.width_px,
                                    film.height_px, notes);
            });
        if (is_there) continue;
        if (!missing.empty() && missing.back().last == frame - 1)
            missing.back().last = frame;
        else
            missing.push_back({frame, frame, 1});
    }
    return FrameRanges(std::move(missing));
}

void remove_leftovers(const std::vector<OutputRequest>& outputs, const FrameRanges& frames) {
    namespace fs = std::filesystem;
    for (const OutputRequest& output : outputs) {
        std::vector<fs::path> leftovers;
        std::error_code error;
        for (const auto& entry : fs::directory_iterator(sequence_folder(output.path), error)) {
            const std::string name = name_of_temporary(entry.path().filename().string());
            const auto frame = name.empty() ? std::nullopt : sequence_number(output.path, name);
            if (frame && frames.contains(*frame)) leftovers.push_back(entry.path());
        }
        for (const fs::path& path : leftovers) fs::remove(path, error);  // what stays does no harm
    }
}

}  // namespace carom
