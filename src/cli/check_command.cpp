// carom check, carom schema: what needs neither simulation nor picture.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/against.h"
#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/standard_error.h"
#include "cli/standard_output.h"
#include "core/readable.h"
#include "scene/schema.h"
#include "sweep/file/results.h"

namespace carom {

namespace {

struct CheckOptions {
    std::vector<std::string> scenes;
    bool json = false;
    CommonOptions common;
};

/// File names need be no UTF-8, JSON has to be.
std::string json_text(const nlohmann::ordered_json& json) {
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

nlohmann::ordered_json diagnostic_json(const Diagnostic& d) {
    return {{"file", d.file},
            {"line", d.mark.line},
            {"column", d.mark.column},
            {"severity", d.severity == Severity::kError ? "error" : "warning"},
            {"message", d.message}};
}

int check(const CheckOptions& options, const Interrupt& interrupt) {
    bool valid = true;
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    std::size_t checked = 0;
    for (const std::string& path : options.scenes) {
        interrupt.check();
        interrupt.reached(fmt::format("after {} of {} scenes", checked++, options.scenes.size()));
        const std::vector<Override> overrides = options.common.overrides();
        const std::string text = read_scene_text(path);
        SceneResult result = read_scene(text, path == "-" ? "<stdin>" : path, overrides);
        // A scene is as right as the run that it is shown against.
        if (const auto second =
                result.scene ? read_second(*result.scene, text, overrides) : std::nullopt;
            second && !second->scene) {
            result.diagnostics = second->diagnostics;
            result.scene.reset();
        }
        valid = valid && result.scene.has_value();
        nlohmann::ordered_json found = nlohmann::ordered_json::array();
        for (const Diagnostic& d : result.diagnostics.items()) {
            if (options.json)
                found.push_back(diagnostic_json(d));
            else if (!options.common.quiet || d.severity == Severity::kError)
                write_standard_error(d.shown());
        }
        json.push_back({{"file", path},
                        {"valid", result.scene.has_value()},
                        {"diagnostics", std::move(found)}});
        if (!options.json && !options.common.quiet && result.scene)
            write_standard_output(fmt::format("{}: valid, {} balls, {} surfaces\n", readable(path),
                                              result.scene->balls.size(),
                                              result.scene->surfaces.size()));
    }
    if (options.json) write_standard_output(json_text(json));
    return valid ? kExitDone : kExitInvalidScene;
}

}  // namespace

void add_check_command(CLI::App& app, Run& run, const Interrupt& interrupt) {
    auto* command = app.add_subcommand("check", "Validate scenes, print every mistake");
    auto options = std::make_shared<CheckOptions>();
    command->footer("  carom check scenes/*.yaml\n  carom check --json scene.yaml\n");
    command->add_option("scenes", options->scenes, "Scene files, - for standard input")
        ->required()
        ->type_name("SCENE...");
    command->add_flag("--json", options->json, "Diagnostics as JSON on standard output");
    add_scene_options(*command, options->common);
    command->add_flag("-q,--quiet", options->common.quiet, "Errors only");
    command->callback([options, &run, &interrupt] {
        run = [options, &interrupt] { return check(*options, interrupt); };
    });
}

void add_schema_command(CLI::App& app, Run& run) {
    auto* command = app.add_subcommand("schema", "Print the JSON Schema of scenes or sweeps");
    auto reference = std::make_shared<bool>(false);
    auto file = std::make_shared<std::string>("scene");
    command->add_option("file", *file, "Of which files: scene (default) or sweep")
        ->check(CLI::IsMember({"scene", "sweep"}))
        ->type_name("scene|sweep");
    command->add_flag("--reference", *reference,
                      "Print the reference of docs/scene.md or docs/sweeps.md (Markdown) instead");
    command->callback([reference, file, &run] {
        run = [reference, file] {
            const FileKind kind = *file == "sweep" ? FileKind::kSweep : FileKind::kScene;
            std::string text = *reference ? reference_markdown(kind) : json_schema(kind);
            if (*reference && kind == FileKind::kSweep) text += result_reference_markdown();
            write_standard_output(text);
            return int{kExitDone};
        };
    });
}

}  // namespace carom
