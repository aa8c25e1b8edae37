// The parser's own tables as plain values, for all that is made from them: completions, the manual
// page, a listing for programs.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace carom {

struct OptionRow {
    std::vector<std::string> names;    ///< "-o", "--output"; empty for an argument
    std::string value;                 ///< what its value is called, e.g. "OUT.png"; "" for a flag
    std::vector<std::string> choices;  ///< the words that the value may be; empty: any
    std::string text;
    std::string fallback;  ///< the default as text; "" where the text says it, or there is none
    bool required = false;
    bool argument = false;  ///< goes by its place
};

struct CommandRow {
    std::string path;  ///< "golden check"; "" for the program itself
    std::string text;
    std::string examples;                  ///< lines, each with an end
    std::vector<std::string> subcommands;  ///< their last words
    std::vector<OptionRow> options;
};

/// The program, then each command, in the order of the help; those with commands of their own
/// before these.
std::vector<CommandRow> command_table(const CLI::App& app);

/// The name of an option's value alone: CLI11 adds what its checks have to say.
std::string value_name(const CLI::Option& option);

/// The words that an option's value may be, from its check or from a name such as "bottom|top".
std::vector<std::string> value_choices(const CLI::Option& option);

/// The table for programs.
std::string command_table_json(const std::vector<CommandRow>& table);

}  // namespace carom
