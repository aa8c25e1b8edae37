// carom compare: two pictures, two folders of frames, or two films.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/standard_output.h"
#include "core/failure.h"
#include "media/film_reader.h"
#include "media/output_file.h"
#include "media/png.h"

namespace carom {

namespace {

namespace fs = std::filesystem;

/// Decoded films have been through a lossy codec, on processors that may round differently.
constexpr int kFilmTolerance = 4;

struct CompareOptions {
    std::string a, b;
    std::string difference;
    int tolerance = -1;  ///< -1: the default for what is compared
    double most_differing = ImageTolerance{}.differing;
    bool json = false;
    bool overwrite = false;
};

enum class Kind { kPicture, kFolder, kFilm };

Kind kind_of(const std::string& path) {
    if (fs::is_directory(path)) return Kind::kFolder;
    if (!fs::exists(path))
        throw Failure(FailureKind::kInput, fmt::format("{}: no such file or folder", path));
    return fs::path(path).extension() == ".png" ? Kind::kPicture : Kind::kFilm;
}

/// What has been compared so far; keeps the worst pair for the difference picture.
class Comparison {
  public:
    explicit Comparison(const ImageTolerance& tolerance) : tolerance_(tolerance) {}

    void add(const std::string& name, const Image& a, const Image& b) {
        const ImageDifference d = compare_images(a, b);
        ++compared_;
        if (!tolerance_.accepts(d)) failed_.push_back(name);
        if (compared_ == 1 || worse(d, worst_)) {
            worst_ = d;
            worst_name_ = name;
            if (d.same_size) picture_ = difference_image(a, b);
        }
    }
    void add_missing(const std::string& name) { failed_.push_back(name + " (only in one)"); }

    bool same() const { return failed_.empty(); }
    const Image& worst_picture() const { return picture_; }

    std::string text() const {
        std::string what =
            worst_.same_size
                ? fmt::format(
                      "largest difference {} of 255, {:.4f} % of pixels differ, "
                      "luma PSNR {:.2f} dB",
                      worst_.largest, 100 * worst_.differing_fraction(), worst_.psnr_luma_db)
                : "the sizes differ";
        std::string result =
            fmt::format("{}: {} compared, worst {}: {}\n", same() ? "same" : "different", compared_,
                        worst_name_, what);
        for (const std::string& name : failed_) result += fmt::format("differs: {}\n", name);
        return result;
    }

    nlohmann::ordered_json json() const {
        nlohmann::ordered_json json = {{"same", same()},
                                       {"compared", compared_},
                                       {"worst", worst_name_},
                                       {"same_size", worst_.same_size},
                                       {"largest", worst_.largest},
                                       {"differing_fraction", worst_.differing_fraction()},
                                       {"differs", failed_}};
        // JSON has no infinity: identical pictures have no PSNR.
        json["psnr_luma_db"] = std::isfinite(worst_.psnr_luma_db)
                                   ? nlohmann::ordered_json(worst_.psnr_luma_db)
                                   : nlohmann::ordered_json(nullptr);
        return json;
    }

  private:
    static bool worse(const ImageDifference& a, const ImageDifference& b) {
        if (a.same_size != b.same_size) return !a.same_size;
        if (a.largest != b.largest) return a.largest > b.largest;
        return a.differing > b.differing;
    }

    ImageTolerance tolerance_;
    std::int64_t compared_ = 0;
    std::vector<std::string> failed_;
    ImageDifference worst_;
    std::string worst_name_;
    Image picture_;
};

std::set<std::string> png_names(const std::string& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".png") names.insert(entry.path().filename().string());
    return names;
}

void compare_folders(const CompareOptions& options, const Interrupt& interrupt,
                     Comparison& comparison) {
    const std::set<std::string> a = png_names(options.a), b = png_names(options.b);
    if (a.empty() && b.empty())
        throw Failure(FailureKind::kInput,
                      fmt::format("{} and {} hold no .png files", options.a, options.b));
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
        comparison.add(name, read_png((fs::path(options.a) / name).string()),
                       read_png((fs::path(options.b) / name).string()));
    }
}

void compare_films(const CompareOptions& options, const Interrupt& interrupt,
                   Comparison& comparison) {
    FilmReader a(options.a), b(options.b);
    Image frame_a, frame_b;
    for (int k = 0;; ++k) {
        interrupt.check();
        interrupt.reached(fmt::format("after {} frames", k));
        const bool has_a = a.next(frame_a), has_b = b.next(frame_b);
        if (!has_a && !has_b) break;
        const std::string name = fmt::format("frame {}", k);
        if (has_a && has_b)
            comparison.add(name, frame_a, frame_b);
        else
            comparison.add_missing(name);
    }
}

int compare(const CompareOptions& options, const Interrupt& interrupt) {
    const Kind kind = kind_of(options.a);
    if (kind_of(options.b) != kind)
        throw Failure(
            FailureKind::kInput,
            fmt::format("{} and {} are not of one kind: compare two pictures, two folders "
                        "or two films",
                        options.a, options.b));
    if (!options.difference.empty()) require_writable(options.difference, options.overwrite);

    ImageTolerance tolerance;
    tolerance.differing = options.most_differing;
    if (kind == Kind::kFilm) {
        tolerance.channel = kFilmTolerance;
        tolerance.differing = 1;
    }
    if (options.tolerance >= 0) tolerance.channel = options.tolerance;

    Comparison comparison(tolerance);
    switch (kind) {
        case Kind::kPicture:
            comparison.add(options.a, read_png(options.a), read_png(options.b));
            break;
        case Kind::kFolder:
            compare_folders(options, interrupt, comparison);
            break;
        case Kind::kFilm:
            compare_films(options, interrupt, comparison);
            break;
    }
    if (!options.difference.empty() && comparison.worst_picture().width_px > 0)
        write_png(options.difference, comparison.worst_picture());
    write_standard_output(options.json ? comparison.json().dump(2) + "\n" : comparison.text());
    return comparison.same() ? kExitDone : kExitDifferent;
}

}  // namespace

void add_compare_command(CLI::App& app, Run& run, const Interrupt& interrupt) {
    auto* command = app.add_subcommand("compare", "Compare two pictures, folders or films");
    auto options = std::make_shared<CompareOptions>();
    command->add_option("a", options->a, "Picture, folder of PNGs, or film")->required();
    command->add_option("b", options->b, "The same of the other")->required();
    command->add_option("--diff", options->difference, "Write a picture of the worst difference")
        ->type_name("D.png");
    command
        ->add_option("--tolerance", options->tolerance,
                     "Largest difference of any channel, of 255 (default 2; films 4)")
        ->check(CLI::Range(0, 255));
    command
        ->add_option("--max-differing", options->most_differing,
                     "Largest fraction of pixels that differ at all")
        ->check(CLI::Range(0.0, 1.0));
    command->add_flag("--json", options->json, "Result as JSON");
    command->add_flag("-y,--overwrite", options->overwrite, "Replace the picture of --diff");
    command->callback([options, &run, &interrupt] {
        run = [options, &interrupt] { return compare(*options, interrupt); };
    });
}

}  // namespace carom
