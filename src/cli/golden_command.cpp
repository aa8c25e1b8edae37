// carom golden: stills of scenes against pictures kept in a folder.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>

#include "cli/backend_option.h"
#include "cli/commands.h"
#include "cli/distinct_files.h"
#include "cli/exit_codes.h"
#include "cli/golden_stills.h"
#include "cli/interrupt.h"
#include "cli/standard_output.h"
#include "core/readable.h"
#include "golden/accept.h"
#include "golden/golden_name.h"
#include "golden/golden_report.h"
#include "media/output_folder.h"
#include "media/png.h"

namespace carom {

namespace {

namespace fs = std::filesystem;

/// Where drawn pictures go: as asked for, or beside the JSON that names them.
std::string drawn_folder(const GoldenOptions& options) {
    if (!options.differences.empty() || options.json.empty()) return options.differences;
    const fs::path json(options.json);
    return (json.parent_path() / (json.stem().string() + "-drawn")).string();
}

/// Before any work.
void require_places(const GoldenOptions& options) {
    std::vector<NamedFile> reports = {
        {"--html", options.html}, {"--junit", options.junit}, {"--json", options.json}};
    std::vector<NamedFile> scenes;
    for (const std::string& scene : options.scenes) scenes.push_back({"SCENE", scene});
    require_distinct(reports, scenes);
    for (const NamedFile& report : reports)
        if (!report.path.empty()) require_writable(report.path, options.common.overwrite);
    const std::string folder = drawn_folder(options);
    if (!folder.empty()) require_folder(folder);
}

/// What was drawn, and how it differs.
void write_pictures(const std::string& folder, const Image& drawn, StillCheck& check) {
    if (folder.empty() || check.outcome == Outcome::kSame) return;
    make_folder(folder);
    const std::string base = (fs::path(folder) / check.still.name).string();
    check.drawn_path = base + ".drawn.png";
    write_text_file(check.drawn_path, check.drawn_png);
    if (!check.changed_png.empty() || !check.difference_png.empty())
        write_png(base + ".diff.png", difference_image(read_png(check.still.golden), drawn));
}

std::string line_of(const StillCheck& check) {
    const std::string path = readable(check.still.golden);
    switch (check.outcome) {
        case Outcome::kSame:
            return fmt::format("same: {}\n", path);
        case Outcome::kMissing:
            return fmt::format("missing: {}\n", path);
        case Outcome::kUnreadable:
            return fmt::format("unreadable: {}: {}\n", path, readable_message(check.why));
        case Outcome::kDifferent:
            break;
    }
    const std::string missed = check.measures.same_size ? "; " + check.missed : "";
    return fmt::format("different: {}: {}{}; drawn by {}\n", path, check.why, missed,
                       check.still.renderer);
}

/// Names what no scene draws: a check of one scene finds the goldens of all others.
void name_orphans(const GoldenOptions& options, const std::vector<std::string>& found) {
    constexpr std::size_t kMostNamed = 10;
    if (options.common.quiet && !options.orphans_fail) return;
    for (std::size_t i = 0; i < std::min(kMostNamed, found.size()); ++i)
        write_standard_output(
            fmt::format("orphan: {}: none of these scenes draws it\n", readable(found[i])));
    if (found.size() > kMostNamed)
        write_standard_output(fmt::format("orphans: {} more\n", found.size() - kMostNamed));
}

void write_reports(const GoldenOptions& options, const GoldenReport& report) {
    const auto write = [&options](const std::string& path, const std::string& text) {
        if (!path.empty())
            write_text_file(path, text, Durability::kSynced, options.common.existing());
    };
    write(options.html, options.html.empty() ? "" : html_page(report));
    write(options.junit, junit_xml(report));
    write(options.json, report_json(report, options.json));
}

int check(const GoldenOptions& options, const Interrupt& interrupt) {
    require_places(options);
    GoldenReport report{CAROM_VERSION, options.folder, options.limits.any, {}, {}, {}};
    GoldenStills stills(options, interrupt);
    const std::string folder = drawn_folder(options);
    for (const std::string& scene : options.scenes) {
        const bool valid = stills.for_each(scene, [&](const DrawnStill& still, const Image& drawn) {
            report.stills.push_back(check_still(still, drawn, options.limits));
            StillCheck& found = report.stills.back();
            write_pictures(folder, drawn, found);
            if (found.outcome != Outcome::kSame || !options.common.quiet)
                write_standard_output(line_of(found));
            if (options.html.empty()) {  // nobody shows them
                found.golden_png.clear();
                found.changed_png.clear();
                found.difference_png.clear();
            }
        });
        if (!valid) report.invalid_scenes.push_back(scene);
    }
    report.orphans = orphans(options.folder, stills.names());
    name_orphans(options, report.orphans);
    const bool same = report.count(Outcome::kSame) == static_cast<int>(report.stills.size()) &&
                      (report.orphans.empty() || !options.orphans_fail);
    if (!same || !options.common.quiet) write_standard_output(report.counts_text() + "\n");
    write_reports(options, report);
    if (!report.invalid_scenes.empty()) return kExitInvalidScene;
    return same ? kExitDone : kExitDifferent;
}

int update(const GoldenOptions& options, const Interrupt& interrupt) {
    GoldenStills stills(options, interrupt);
    if (!options.dry_run) prepare_folder(options.folder);
    bool valid = true;
    int changed = 0;
    for (const std::string& scene : options.scenes)
        valid &= stills.for_each(scene, [&](const DrawnStill& still, const Image& drawn) {
            // A golden that still holds stays as it is, so that its history shows real changes.
            const StillCheck found = check_still(still, drawn, options.limits);
            if (found.outcome == Outcome::kSame) return;
            ++changed;
            if (!options.dry_run) write_text_file(still.golden, found.drawn_png);
            write_standard_output(fmt::format("{}: {}: {}\n",
                                              options.dry_run ? "would write" : "written",
                                              readable(still.golden), readable_message(found.why)));
        });
    name_orphans(options, orphans(options.folder, stills.names()));
    if (options.dry_run)
        write_standard_output(
            fmt::format("{} of {} would be written\n", changed, stills.names().size()));
    return valid ? kExitDone : kExitInvalidScene;
}

struct AcceptOptions {
    std::string report;
    std::vector<std::string> only;
    bool dry_run = false;
};

int accept(const AcceptOptions& options) {
    const std::vector<Acceptance> chosen = acceptances(options.report, options.only);
    if (!options.dry_run) take(chosen);
    for (const Acceptance& a : chosen)
        write_standard_output(fmt::format("{}: {} {}\n",
                                          options.dry_run ? "would accept" : "accepted",
                                          readable(a.golden), a.replaces ? "(replaced)" : "(new)"));
    if (chosen.empty()) write_standard_output("nothing to accept: all stills were the same\n");
    return kExitDone;
}

void add_limits(CLI::App& action, GoldenOptions& options) {
    action
        .add_option("--tolerance", options.limits.any.channel,
                    "Largest difference of any channel, of 255")
        ->check(CLI::Range(0, 255))
        ->type_name("0-255")
        ->capture_default_str();
    action
        .add_option("--same-renderer", options.limits.same_renderer,
                    "The same for goldens that say that this renderer drew them (default: as "
                    "--tolerance)")
        ->check(CLI::Range(0, 255))
        ->type_name("0-255");
    action
        .add_option("--max-differing", options.limits.any.differing,
                    "Largest fraction of pixels that differ at all, 0 to 1; both limits hold")
        ->check(CLI::Range(0.0, 1.0))
        ->type_name("F")
        ->capture_default_str();
}

void add_check_options(CLI::App& action, GoldenOptions& options) {
    action
        .add_option(
            "--diffs", options.differences,
            "Folder for pictures of what differs, replaced where they exist (default: none; with "
            "--json, NAME-drawn beside it)")
        ->type_name("DIR");
    action
        .add_option("--html", options.html, "Write a page that shows what differs (default: none)")
        ->type_name("PAGE.html");
    action
        .add_option("--junit", options.junit, "Write JUnit's XML, for a CI service (default: none)")
        ->type_name("OUT.xml");
    action
        .add_option("--json", options.json,
                    "Write a report that 'carom golden accept' takes pictures from (default: none)")
        ->type_name("REPORT.json");
    action.add_flag("--orphans-fail", options.orphans_fail,
                    "Fail also where a golden belongs to none of the stills");
    action.add_flag("-y,--overwrite", options.common.overwrite,
                    "Replace reports that exist (default: they are kept, exit code 4)");
}

void add_accept(CLI::App& command, Run& run) {
    auto* action = command.add_subcommand("accept", "Take drawn pictures of a report as goldens");
    auto options = std::make_shared<AcceptOptions>();
    action->footer(
        "  carom golden accept --from report.json\n"
        "  carom golden accept --from report.json --only figure8-t1.000000,court\n");
    action->add_option("--from", options->report, "Report of 'carom golden check --json'")
        ->required()
        ->type_name("REPORT.json");
    action
        ->add_option("--only", options->only,
                     "Stills or scenes to take, with commas between them (default: all that are "
                     "not the same)")
        ->type_name("NAME,...")
        ->delimiter(',')
        ->take_all()
        ->allow_extra_args(false);
    action->add_flag("--dry-run", options->dry_run, "Say what would be taken, and take nothing");
    action->callback([options, &run] { run = [options] { return accept(*options); }; });
}

}  // namespace

void add_golden_command(CLI::App& app, Run& run, const Interrupt& interrupt) {
    auto* command = app.add_subcommand("golden", "Compare stills with kept pictures, or keep them");
    command->require_subcommand(1);
    auto options = std::make_shared<GoldenOptions>();
    command->footer(
        "  carom golden update scenes/*.yaml --dir goldens\n"
        "  carom golden check scenes/*.yaml --dir goldens --html report.html --json report.json\n"
        "  carom golden accept --from report.json --only figure8-t1.000000\n");
    const auto add = [&](const char* name, const char* what, auto function) {
        auto* action = command->add_subcommand(name, what);
        action->footer(fmt::format("  carom golden {} scenes/*.yaml --dir goldens\n", name));
        action->add_option("scenes", options->scenes, "Scene files, with names that differ")
            ->required()
            ->type_name("SCENE...");
        action->add_option("--dir", options->folder, "Folder of the goldens")
            ->required()
            ->type_name("DIR");
        action
            ->add_option("--time", options->times,
                         "Instant in seconds (repeatable; default: the scene's film.stills)")
            ->type_name("T")
            ->take_all()
            ->allow_extra_args(false);
        add_limits(*action, *options);
        add_scene_options(*action, options->common);
        add_picture_options(*action, options->common);
        add_backend_option(*action);
        add_progress_options(*action, options->common);
        add_time_limit_option(*action, interrupt);
        action->callback([options, function, &run, &interrupt] {
            run = [options, function, &interrupt] { return function(*options, interrupt); };
        });
        return action;
    };
    add_check_options(
        *add("check", "Fail (exit code 5) where a still differs from its golden", check), *options);
    add("update", "Write goldens that are missing or differ", update)
        ->add_flag("--dry-run", options->dry_run, "Say what would be written, and write nothing");
    add_accept(*command, run);
}

}  // namespace carom
