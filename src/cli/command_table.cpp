#include "cli/command_table.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

namespace carom {

namespace {

std::vector<std::string> split(const std::string& text, char between) {
    std::vector<std::string> words;
    std::istringstream stream(text);
    for (std::string word; std::getline(stream, word, between);) words.push_back(word);
    return words;
}

OptionRow row_of(const CLI::Option& option) {
    OptionRow row;
    for (const std::string& s : option.get_snames()) row.names.push_back("-" + s);
    for (const std::string& l : option.get_lnames()) row.names.push_back("--" + l);
    row.argument = option.get_positional();
    if (row.argument) row.names.clear();
    row.value = value_name(option);
    row.choices = value_choices(option);
    row.text = option.get_description();
    row.fallback = option.get_default_str();
    row.required = option.get_required();
    return row;
}

void add_command(const CLI::App& app, const std::string& path, std::vector<CommandRow>& table) {
    CommandRow row{path, app.get_description(), app.get_footer(), {}, {}};
    for (const CLI::Option* option : app.get_options()) row.options.push_back(row_of(*option));
    for (const CLI::App* command : app.get_subcommands({}))
        row.subcommands.push_back(command->get_name());
    table.push_back(std::move(row));
    for (const CLI::App* command : app.get_subcommands({}))
        add_command(*command, path.empty() ? command->get_name() : path + " " + command->get_name(),
                    table);
}

}  // namespace

std::string value_name(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    return type.substr(0, type.find(':'));
}

std::vector<std::string> value_choices(const CLI::Option& option) {
    const std::string name = value_name(option), type = option.get_type_name();
    if (name.find('|') != std::string::npos) return split(name, '|');
    // A check of membership says "NAME:{a,b}".
    const std::size_t open = type.find(":{"), close = type.rfind('}');
    if (open == std::string::npos || close == std::string::npos || close < open) return {};
    return split(type.substr(open + 2, close - open - 2), ',');
}

std::vector<CommandRow> command_table(const CLI::App& app) {
    std::vector<CommandRow> table;
    add_command(app, "", table);
    return table;
}

std::string command_table_json(const std::vector<CommandRow>& table) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const CommandRow& command : table) {
        nlohmann::ordered_json options = nlohmann::ordered_json::array();
        for (const OptionRow& o : command.options)
            options.push_back({{"names", o.names},
                               {"value", o.value},
                               {"choices", o.choices},
                               {"text", o.text},
                               {"default", o.fallback},
                               {"required", o.required},
                               {"argument", o.argument}});
        list.push_back({{"command", command.path},
                        {"text", command.text},
                        {"examples", command.examples},
                        {"commands", command.subcommands},
                        {"options", std::move(options)}});
    }
    return list.dump(2) + "\n";
}

}  // namespace carom
