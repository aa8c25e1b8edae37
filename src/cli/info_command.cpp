// carom info: versions, and what of the machine carom can work with.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "cli/standard_output.h"
#include "cli/stats.h"
#include "core/failure.h"
#include "core/readable.h"
#include "media/versions.h"
#include "render/gl/backend_probe.h"
#include "render/versions.h"
#include "report/gnuplot.h"
#include "scene/scene.h"

namespace carom {

namespace {

/// A part of the machine, by what it is called on the command line.
struct Part {
    std::string name;
    bool found = false;
    std::string text;      ///< what was found, or why nothing was
    std::string packages;  ///< of Debian; "" where none is to be named
};

std::vector<Part> backends() {
    struct Row {
        const char* name;
        BackendChoice choice;
        const char* packages;
    };
    std::vector<Part> result;
    for (const Row& row : {Row{"osmesa", BackendChoice::kOsMesa, "libosmesa6"},
                           Row{"egl", BackendChoice::kEgl, "libegl1 libgl1-mesa-dri"}}) {
        const BackendProbe probe = probe_backend(row.choice);
        result.push_back({row.name, probe.found, readable_message(probe.text), row.packages});
    }
    return result;
}

std::vector<Part> codecs() {
    std::vector<Part> result;
    for (const FoundCodec& codec : found_codecs())
        result.push_back({std::string(codec.codec->name), codec.found,
                          codec.found
                              ? fmt::format("{} ({})", codec.codec->title, codec.codec->encoder)
                              : fmt::format("this FFmpeg has no encoder {}", codec.codec->encoder),
                          ""});
    return result;
}

Part gnuplot() {
    Part part{"gnuplot", false, "", "gnuplot-nox"};
    try {
        part.text = gnuplot_version();
        part.found = true;
    } catch (const Failure& failure) {
        part.text = readable_message(failure.what());
    }
    return part;
}

nlohmann::ordered_json method_defaults() {
    const Simulation simulation;
    return {{"method", simulation.method == Method::kExact ? "exact" : "fixed"},
            {"step", simulation.step},
            {"solver", simulation.solver == Solver::kWorld ? "world" : "quick"},
            {"iterations", simulation.iterations},
            {"restitution_constant", simulation.restitution_constant}};
}

/// What the machine has, in the order in which it is printed.
struct Facts {
    std::map<std::string, std::string> versions = library_versions();
    std::vector<Part> backends = carom::backends();
    std::vector<Part> codecs = carom::codecs();
    Part gnuplot = carom::gnuplot();

    /// Of the back end that `auto` takes; where there is none, why.
    std::string renderer() const {
        for (const Part& backend : backends)
            if (backend.found) return backend.text;
        return fmt::format("none: {}; {}", backends.front().text, backends.back().text);
    }
};

nlohmann::ordered_json part_json(const Part& part, const char* what) {
    nlohmann::ordered_json json = {{"found", part.found}};
    json[part.found ? what : "missing"] = part.text;
    if (!part.found && !part.packages.empty()) json["packages"] = part.packages;
    return json;
}

std::string facts_json(const Facts& facts) {
    nlohmann::ordered_json json;
    for (const auto& [name, version] : facts.versions) json[name] = version;
    json["renderer"] = facts.renderer();
    for (const Part& part : facts.backends)
        json["backends"][part.name] = part_json(part, "renderer");
    json["codecs"] = nlohmann::ordered_json::object();
    for (const Part& part : facts.codecs) json["codecs"][part.name] = part_json(part, "encoder");
    json["gnuplot"] = part_json(facts.gnuplot, "version");
    json["font"] = font_name();
    json["defaults"] = method_defaults();
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string line(const std::string& name, const std::string& text) {
    return fmt::format("{:<14} {}\n", name, text);
}

std::string part_line(const std::string& name, const Part& part) {
    if (part.found) return line(name, part.text);
    const std::string packages =
        part.packages.empty() ? "" : fmt::format(" (packages: {})", part.packages);
    return line(name, fmt::format("missing: {}{}", part.text, packages));
}

std::string facts_text(const Facts& facts) {
    std::string text;
    for (const auto& [name, version] : facts.versions) text += line(name, version);
    text += "\n" + line("renderer", facts.renderer());
    for (const Part& part : facts.backends) text += part_line("  " + part.name, part);
    text += "\n";
    if (!facts.codecs.empty()) text += line("codecs", "of --codec");
    for (const Part& part : facts.codecs) text += part_line("  " + part.name, part);
    text += part_line("gnuplot", facts.gnuplot) + line("font", font_name()) + "\n";
    text += line("defaults", "of simulation");
    const nlohmann::ordered_json defaults = method_defaults();
    for (const auto& [key, value] : defaults.items())
        text += line("  " + key, value.is_string() ? value.get<std::string>() : value.dump());
    return text;
}

}  // namespace

void add_info_command(CLI::App& app, Run& run) {
    auto* command = app.add_subcommand(
        "info", "Print versions, and the renderer and codecs that this machine has");
    command->footer("  carom info\n  carom info --json\n");
    auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "As JSON");
    command->callback([json, &run] {
        run = [json] {
            const Facts facts;
            write_standard_output(*json ? facts_json(facts) : facts_text(facts));
            return int{kExitDone};
        };
    });
}

}  // namespace carom
