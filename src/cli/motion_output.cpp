#include "cli/motion_output.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <fstream>

#include "cli/standard_output.h"
#include "core/failure.h"
#include "core/temporary_folder.h"
#include "export/motion_glb.h"
#include "export/motion_json.h"
#include "export/motion_npz.h"
#include "media/text_file.h"

namespace carom {

namespace {

struct FormatRow {
    MotionFormat format;
    const char* word;
};
constexpr std::array<FormatRow, 4> kFormats = {{{MotionFormat::kCsv, "csv"},
                                                {MotionFormat::kJson, "json"},
                                                {MotionFormat::kNpz, "npz"},
                                                {MotionFormat::kGlb, "glb"}}};

/// An archive is written with its sizes behind: a pipe gets it when it is whole.
void write_npz(const Scene& scene, const Motion& motion, const std::string& path, Existing existing,
               const RowTimes& times, const std::function<void(double)>& told) {
    if (path != "-") {
        OutputFile file(path, existing);
        write_motion_npz(scene, motion, times, file.temporary_path(), told);
        file.commit();
        return;
    }
    const TemporaryFolder folder(FailureKind::kOutput);
    const std::string made = folder.file("motion.npz");
    write_motion_npz(scene, motion, times, made, told);
    std::ifstream file(made, std::ios::binary);
    std::string block(1 << 20, '\0');
    while (file.read(block.data(), static_cast<std::streamsize>(block.size())), file.gcount() > 0)
        write_standard_output({block.data(), static_cast<std::size_t>(file.gcount())});
    if (file.bad())
        throw Failure(FailureKind::kOutput, fmt::format("reading {} back failed", made));
}

}  // namespace

MotionFormat motion_format(const std::string& path, const std::string& format) {
    if (path != "-" && !format.empty())
        throw Failure(
            FailureKind::kInput,
            fmt::format("--format {}: is for -o - alone; the name of '{}' says its format", format,
                        path));
    std::string word = format;
    if (path != "-")
        if (const std::string extension = std::filesystem::path(path).extension().string();
            !extension.empty())
            word = extension.substr(1);
    for (const FormatRow& row : kFormats)
        if (word == row.word) return row.format;
    return MotionFormat::kCsv;
}

bool has_rows(MotionFormat format) {
    return format == MotionFormat::kCsv || format == MotionFormat::kNpz;
}

void write_text_output(const std::string& path, Existing existing, const Interrupt& interrupt,
                       const std::function<void(const TextSink&)>& write) {
    if (path == "-") {
        write([&](std::string_view text) {
            interrupt.check();
            write_standard_output(text);
        });
        return;
    }
    TextFile file(path, existing);
    write([&](std::string_view text) {
        interrupt.check();
        file.write(text);
    });
    file.commit();
}

void write_motion(MotionFormat format, const Scene& scene, const Motion& motion,
                  const std::string& path, Existing existing, const Interrupt& interrupt,
                  const FrameRate& rate, const std::function<void(double)>& told) {
    const auto part = [&](double done) {
        interrupt.check();
        told(done);
    };
    if (format == MotionFormat::kNpz) {
        const RowTimes times(motion.duration, rate.numerator, rate.denominator);
        write_npz(scene, motion, path, existing, times, part);
        return;
    }
    write_text_output(path, existing, interrupt, [&](const TextSink& sink) {
        if (format == MotionFormat::kGlb)
            sink(motion_glb(scene, motion, CAROM_VERSION, part));
        else
            write_motion_json(scene, motion, CAROM_VERSION, sink);
    });
}

}  // namespace carom
