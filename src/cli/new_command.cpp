// carom new: a scene to begin with.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "cli/options.h"
#include "cli/standard_error.h"
#include "cli/standard_output.h"
#include "core/diagnostics.h"
#include "core/failure.h"
#include "core/readable.h"
#include "media/output_file.h"
#include "report/embedded_scenes.h"

namespace carom {

namespace {

namespace fs = std::filesystem;

struct NewOptions {
    std::string name;
    std::string like = "drop";
    bool list = false;
    bool overwrite = false;
    bool quiet = false;
};

std::vector<std::string> example_names() {
    std::vector<std::string> names;
    for (const std::string_view name : embedded_scene_names()) names.emplace_back(name);
    return names;
}

/// The value of `title:` in an example's text.
std::string title_of(std::string_view text) {
    constexpr std::string_view kKey = "\ntitle: ";
    const std::size_t at = text.find(kKey);
    if (at == std::string_view::npos) return "";
    text.remove_prefix(at + kKey.size());
    std::string title(text.substr(0, text.find('\n')));
    if (title.size() > 1 && title.front() == '"') title = title.substr(1, title.size() - 2);
    return title;
}

int list_examples() {
    for (const std::string& name : example_names())
        write_standard_output(fmt::format("{:<20} {}\n", name, title_of(embedded_scene(name))));
    return kExitDone;
}

std::string file_of(const std::string& name) {
    const std::string extension = fs::path(name).extension().string();
    return name == "-" || extension == ".yaml" || extension == ".yml" ? name : name + ".yaml";
}

int make_scene(const NewOptions& options) {
    if (options.list) return list_examples();
    if (options.name.empty())
        throw Failure(
            FailureKind::kInput,
            "new wants the name of a scene, e.g. 'carom new ball'; --list names examples");
    const std::string_view text = embedded_scene(options.like);
    const std::string path = file_of(options.name);
    if (path == "-") {
        write_standard_output(text);
        return kExitDone;
    }
    require_writable(path, options.overwrite);
    write_text_file(path, std::string(text), Durability::kSynced, existing_of(options.overwrite));
    if (!options.quiet) {
        const std::string shown = readable(path);
        say("wrote {0}; carom render {0} -o {1}.mp4 films it\n", shown,
            readable(fs::path(path).stem().string()));
    }
    return kExitDone;
}

}  // namespace

void add_new_command(CLI::App& app, Run& run) {
    auto* command = app.add_subcommand("new", "Write a scene to begin with");
    auto options = std::make_shared<NewOptions>();
    command->footer(
        "  carom new ball\n"
        "  carom new heap --like pile\n"
        "  carom new --list\n");
    command
        ->add_option("name", options->name,
                     "The scene's file, with or without .yaml; - for standard output")
        ->type_name("NAME");
    command->add_option("--like", options->like, "The example that it begins as")
        ->check(CLI::IsMember(example_names()))
        ->type_name("EXAMPLE")
        ->capture_default_str();
    command->add_flag("--list", options->list, "Name the examples, and write nothing");
    command->add_flag("-y,--overwrite", options->overwrite,
                      "Replace a file that exists (default: it is kept, exit code 4)");
    command->add_flag("-q,--quiet", options->quiet, "Errors only");
    command->callback([options, &run] { run = [options] { return make_scene(*options); }; });
}

}  // namespace carom
