// carom compare: two pictures, two folders of frames, or two films.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "cli/commands.h"
#include "cli/comparison.h"
#include "cli/distinct_files.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/standard_output.h"
#include "core/failure.h"
#include "media/file_kind.h"
#include "media/film_reader.h"
#include "media/output_file.h"
#include "media/png.h"
#include "media/png_measures.h"

namespace carom {

namespace {

namespace fs = std::filesystem;

/// Decoded films have been through a lossy codec, on processors that may round differently.
constexpr int kFilmTolerance = 4;

struct CompareOptions {
    std::string a, b;
    std::string difference;
    std::optional<int> tolerance;  ///< none: the default for what is compared
    std::optional<double> most_differing;
    bool json = false;
    bool overwrite = false;
};

enum class Kind { kPicture, kFolder, kFilm };

[[noreturn]] void refuse_picture(const std::string& path, const FileContent& content) {
    throw Failure(
        FailureKind::kInput,
        fmt::format("{} is a {} picture; pictures are compared as PNGs", path, content.name));
}

Kind kind_of(const std::string& path) {
    if (fs::is_directory(path)) return Kind::kFolder;
    if (!fs::exists(path))
        throw Failure(FailureKind::kInput, fmt::format("{}: no such file or folder", path));
    const FileContent content = file_content(path);
    switch (content.kind) {
        case PictureFileKind::kPng:
            return Kind::kPicture;
        case PictureFileKind::kOtherPicture:
            refuse_picture(path, content);
        case PictureFileKind::kLfsPointer:
            throw Failure(FailureKind::kInput, fmt::format("{}: {}", path, kLfsAdvice));
        case PictureFileKind::kEmpty:
            throw Failure(FailureKind::kInput, fmt::format("{} is empty", path));
        case PictureFileKind::kOther:
            break;
    }
    return Kind::kFilm;
}

/// The folder's PNGs, whatever the case of their extension. Other pictures would be passed over in
/// silence: they are refused.
std::set<std::string> png_names(const std::string& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        const FileContent content = file_content(entry.path().string());
        if (content.kind == PictureFileKind::kOtherPicture)
            refuse_picture(entry.path().string(), content);
        std::string extension = entry.path().extension().string();
        std::transform(extension.begin(), extension.end(), extension.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        if (content.kind == PictureFileKind::kPng || extension == ".png")
            names.insert(entry.path().filename().string());
    }
    if (names.empty())
        throw Failure(FailureKind::kInput, fmt::format("{} holds no PNG: there is nothing to "
                                                       "compare",
                                                       folder));
    return names;
}

void add_pictures(const std::string& name, const std::string& a, const std::string& b,
                  Comparison& comparison) {
    comparison.add(name, measure_pngs(a, b),
                   [&] { return difference_image(read_png(a), read_png(b)); });
}

void compare_folders(const CompareOptions& options, const Interrupt& interrupt,
                     Comparison& comparison) {
    const std::set<std::string> a = png_names(options.a), b = png_names(options.b);
    std::set<std::string> all = a;
    all.insert(b.begin(), b.end());
    std::size_t compared = 0;
    for (const std::string& name : all) {
        interrupt.check();
        interrupt.reached(fmt::format("after {} of {} pictures", compared++, all.size()));
        if (!a.contains(name) || !b.contains(name)) {
            comparison.add_missing(name);
            continue;
        }
        add_pictures(name, (fs::path(options.a) / name).string(),
                     (fs::path(options.b) / name).string(), comparison);
    }
}

/// Two time stamps of one instant, each rounded to its own film's ticks.
bool same_time(const FilmReader& a, const FilmReader& b) {
    constexpr double kRounding_s = 1e-9;  // of the differences of stamps, as doubles
    if (std::isnan(a.time_s()) || std::isnan(b.time_s())) return true;
    return std::abs(a.time_s() - b.time_s()) <= a.time_error_s() + b.time_error_s() + kRounding_s;
}

void compare_films(const CompareOptions& options, const Interrupt& interrupt,
                   Comparison& comparison) {
    FilmReader a(options.a), b(options.b);
    Image frame_a, frame_b;
    for (int k = 0;; ++k) {
        interrupt.check();
        interrupt.reached(fmt::format("after {} frames", k));
        const bool has_a = a.next(frame_a), has_b = b.next(frame_b);
        for (const auto& [has, path] : {std::pair(has_a, options.a), std::pair(has_b, options.b)})
            if (k == 0 && !has)
                throw Failure(FailureKind::kInput, fmt::format("{} holds no frame", path));
        if (!has_a && !has_b) break;
        const std::string name = fmt::format("frame {}", k);
        if (has_a && has_b) {
            comparison.add(name, measure_difference(frame_a, frame_b),
                           [&] { return difference_image(frame_a, frame_b); });
            if (!same_time(a, b)) comparison.add_other_time(name, a.time_s(), b.time_s());
        } else {
            comparison.add_missing(name);
        }
    }
}

/// What is asked for, or the default for what is compared.
ImageTolerance tolerance_for(const CompareOptions& options, Kind kind) {
    ImageTolerance tolerance;
    if (kind == Kind::kFilm) tolerance = {.channel = kFilmTolerance, .differing = 1};
    if (options.tolerance) tolerance.channel = *options.tolerance;
    if (options.most_differing) tolerance.differing = *options.most_differing;
    return tolerance;
}

/// --diff must not be one of the pictures that are compared.
void require_untouched(const CompareOptions& options) {
    std::vector<NamedFile> inputs;
    for (const std::string& path : {options.a, options.b})
        inputs.push_back({"the compared",
                          fs::is_directory(path)
                              ? (fs::path(path) / fs::path(options.difference).filename()).string()
                              : path});
    for (NamedFile& input : inputs)
        if (!fs::exists(input.path)) input.path.clear();
    require_distinct({{"--diff", options.difference}}, inputs);
}

int compare(const CompareOptions& options, const Interrupt& interrupt) {
    require_untouched(options);
    const Kind kind = kind_of(options.a);
    if (kind_of(options.b) != kind)
        throw Failure(
            FailureKind::kInput,
            fmt::format("{} and {} are not of one kind: compare two pictures, two folders "
                        "or two films",
                        options.a, options.b));
    if (!options.difference.empty()) require_writable(options.difference, options.overwrite);

    Comparison comparison(tolerance_for(options, kind), kind == Kind::kFilm ? "frames" : "pictures",
                          !options.difference.empty());
    switch (kind) {
        case Kind::kPicture:
            add_pictures(options.a, options.a, options.b, comparison);
            break;
        case Kind::kFolder:
            compare_folders(options, interrupt, comparison);
            break;
        case Kind::kFilm:
            compare_films(options, interrupt, comparison);
            break;
    }
    if (!options.difference.empty() && comparison.worst_picture().width_px > 0)
        write_png(options.difference, comparison.worst_picture(), PngEffort::kFast,
                  Durability::kSynced, existing_of(options.overwrite));
    write_standard_output(
        options.json ? comparison.json().dump(2, ' ', false,
                                              nlohmann::ordered_json::error_handler_t::replace) +
                           "\n"
                     : comparison.text());
    return comparison.same() ? kExitDone : kExitDifferent;
}

}  // namespace

void add_compare_command(CLI::App& app, Run& run, const Interrupt& interrupt) {
    auto* command = app.add_subcommand("compare", "Compare two pictures, folders or films");
    auto options = std::make_shared<CompareOptions>();
    command->footer(
        "  carom compare a.png b.png --diff difference.png\n"
        "  carom compare frames_a/ frames_b/ --max-differing 0\n"
        "  carom compare a.mp4 b.mp4 --tolerance 8\n");
    command->add_option("a", options->a, "Picture, folder of PNGs, or film")
        ->required()
        ->type_name("A");
    command->add_option("b", options->b, "Another one of the same kind")
        ->required()
        ->type_name("B");
    command
        ->add_option("--diff", options->difference,
                     "Write a picture of the worst difference (default: none)")
        ->type_name("D.png");
    command
        ->add_option("--tolerance", options->tolerance,
                     "Largest difference of any channel, of 255 (default: 2, of films 4)")
        ->check(CLI::Range(0, 255))
        ->type_name("0-255");
    command
        ->add_option("--max-differing", options->most_differing,
                     "Largest fraction of pixels that differ at all, 0 to 1 (default: 0.01, of "
                     "films 1)")
        ->check(CLI::Range(0.0, 1.0))
        ->type_name("F");
    command->add_flag("--json", options->json, "Result as JSON");
    command->add_flag("-y,--overwrite", options->overwrite, "Replace the picture of --diff");
    command->callback([options, &run, &interrupt] {
        run = [options, &interrupt] { return compare(*options, interrupt); };
    });
}

}  // namespace carom
