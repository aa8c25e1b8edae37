#include "cli/backend_option.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <map>
#include <memory>
#include <string>

#include "render/gl/backend.h"

namespace carom {

namespace {

constexpr const char* kVariable = "CAROM_BACKEND";

const std::map<std::string, BackendChoice>& choices() {
    static const std::map<std::string, BackendChoice> all = {{"auto", BackendChoice::kAuto},
                                                             {"osmesa", BackendChoice::kOsMesa},
                                                             {"egl", BackendChoice::kEgl}};
    return all;
}

}  // namespace

void add_backend_option(CLI::App& command) {
    auto choice = std::make_shared<BackendChoice>(BackendChoice::kAuto);
    CLI::Option* option =
        command
            .add_option("--backend", *choice,
                        "Library that gives OpenGL without a display; auto is OSMesa where it is "
                        "installed, else EGL. CAROM_BACKEND in the environment stands for it")
            ->transform(CLI::CheckedTransformer(choices()))
            ->type_name("auto|osmesa|egl")
            ->default_str("auto");
    // (CLI11's own variables of options would also be taken by commands that are not named.)
    command.parse_complete_callback([choice, option] {
        const char* named = std::getenv(kVariable);
        if (option->count() == 0 && named != nullptr && *named != '\0') {
            const auto found = choices().find(named);
            if (found == choices().end())
                throw CLI::ValidationError(kVariable,
                                           fmt::format("{}: expected auto, osmesa or egl", named));
            *choice = found->second;
        }
        choose_backend(*choice);
    });
}

}  // namespace carom
