#include "cli/help.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "cli/command_table.h"
#include "core/diagnostics.h"

namespace carom {

namespace {

constexpr std::size_t kTextColumn = 26;  // where the texts of options begin

/// Columns of the terminal that help goes to; 80 for a file.
std::size_t help_width() {
    constexpr std::size_t kUsual = 80, kLeast = 40;
    winsize size{};
    long columns = 0;
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0) columns = size.ws_col;
    if (const char* named = std::getenv("COLUMNS"); columns == 0 && named != nullptr)
        columns = std::strtol(named, nullptr, 10);
    return columns > 0 ? std::max(kLeast, static_cast<std::size_t>(columns)) : kUsual;
}

std::string option_name(const CLI::Option& option) {
    if (option.get_positional()) return value_name(option);
    std::string name = option.get_snames().empty() ? "    " : "";
    for (const std::string& s : option.get_snames()) name += "-" + s + ", ";
    for (const std::string& l : option.get_lnames()) name += "--" + l + ", ";
    name.resize(name.size() - 2);
    const std::string type = value_name(option);
    return type.empty() ? name : name + " " + type;
}

/// Name and text, the latter in its own column.
std::string entry(const std::string& name, const std::string& text, std::size_t width) {
    std::string line = "  " + name;
    if (line.size() + 2 > kTextColumn)
        line += "\n" + std::string(kTextColumn, ' ');
    else
        line.resize(kTextColumn, ' ');
    return line + wrapped(text, kTextColumn, width) + "\n";
}

std::string option_entry(const CLI::Option& option, std::size_t width) {
    std::string text = option.get_description();
    if (!option.get_default_str().empty())
        text += fmt::format(" (default: {})", option.get_default_str());
    else if (option.get_required() && !option.get_positional())
        text += " (required)";
    return entry(option_name(option), text, width);
}

class Help final : public CLI::FormatterBase {
  public:
    std::string make_help(const CLI::App* app, std::string, CLI::AppFormatMode) const override {
        const std::size_t width = help_width();
        std::string text = wrapped(app->get_description(), 0, width) + "\n";
        if (!app->get_footer().empty()) text += "\nExamples:\n" + app->get_footer();
        text += "\nUsage: " + wrapped(usage(*app), 7, width) + "\n";
        text += options(*app, true, "Arguments", width);
        text += commands(*app, width);
        return text + options(*app, false, "Options", width);
    }

  private:
    static std::string usage(const CLI::App& app) {
        std::string name = app.get_name();
        for (const CLI::App* above = app.get_parent(); above != nullptr;
             above = above->get_parent())
            name = above->get_name() + " " + name;
        for (const CLI::Option* option : app.get_options()) {
            if (option->get_positional()) name += " " + value_name(*option);
            if (!option->get_positional() && option->get_required()) {
                const std::string flag = option->get_snames().empty()
                                             ? "--" + option->get_lnames().front()
                                             : "-" + option->get_snames().front();
                name += fmt::format(" {} {}", flag, value_name(*option));
            }
        }
        return name + (app.get_subcommands({}).empty() ? " [OPTIONS]" : " COMMAND ...");
    }

    static std::string options(const CLI::App& app, bool positional, const char* title,
                               std::size_t width) {
        std::string text;
        for (const CLI::Option* option : app.get_options())
            if (option->get_positional() == positional) text += option_entry(*option, width);
        return text.empty() ? "" : fmt::format("\n{}:\n{}", title, text);
    }

    static std::string commands(const CLI::App& app, std::size_t width) {
        std::string text;
        for (const CLI::App* command : app.get_subcommands({}))
            text += entry(command->get_name(), command->get_description(), width);
        return text.empty() ? "" : "\nCommands:\n" + text;
    }
};

/// The command that the command line has named, with its own subcommand if it has one.
const CLI::App& chosen(const CLI::App& app) {
    const CLI::App* command = &app;
    while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
    return *command;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& words) {
    const std::string nearest = nearest_word(word.substr(0, 100), words);
    return nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest);
}

std::vector<std::string> option_words(const CLI::App& command) {
    std::vector<std::string> words;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
    return words;
}

/// "--progress: 'plian' is none of auto, bar, plain, none (did you mean 'plain'?)", or "".
std::string wrong_choice(const CLI::App& command) {
    for (const CLI::Option* option : command.get_options()) {
        const std::vector<std::string> choices = value_choices(*option);
        if (choices.empty()) continue;
        for (const std::string& word : option->results())
            if (std::find(choices.begin(), choices.end(), word) == choices.end())
                return fmt::format("{}: '{}' is none of {}{}", option->get_name(), word,
                                   fmt::join(choices, ", "), did_you_mean(word, choices));
    }
    return "";
}

}  // namespace

std::string wrapped(const std::string& text, std::size_t indent, std::size_t width) {
    const std::size_t room = std::max<std::size_t>(width, indent + 20) - indent;
    std::string result, line;
    std::istringstream words(text);
    const auto end_line = [&] {
        if (!result.empty()) result += "\n" + std::string(indent, ' ');
        result += line;
        line.clear();
    };
    for (std::string word; words >> word;) {
        if (!line.empty() && line.size() + 1 + word.size() > room) end_line();
        line += (line.empty() ? "" : " ") + word;
    }
    end_line();
    return result;
}

void set_up_help(CLI::App& app) {
    app.formatter(std::make_shared<Help>());
    app.set_help_flag("-h,--help", "Print this help");
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

std::string help_text(const CLI::App& app) {
    const CLI::App& command = chosen(app);
    return Help().make_help(&command, command.get_name(), CLI::AppFormatMode::Normal);
}

std::string usage_error(const CLI::App& app, const std::string& parser_says,
                        const std::string& argument) {
    const CLI::App& command = chosen(app);
    // What is unknown explains what is missing.
    for (const std::string& word : command.remaining())
        if (word.size() > 1 && word.front() == '-')
            return fmt::format("unknown option {}{}", word,
                               did_you_mean(word.substr(0, word.find('=')), option_words(command)));
    std::vector<std::string> names;
    for (const CLI::App* other : command.get_subcommands({})) names.push_back(other->get_name());
    for (const std::string& word : command.remaining())
        if (!names.empty())
            return fmt::format("there is no command '{}'{}", word, did_you_mean(word, names));
    const bool known = std::find(names.begin(), names.end(), argument) != names.end();
    if (&command == &app && !argument.empty() && !known)
        return fmt::format("there is no command '{}'{}", argument, did_you_mean(argument, names));
    const std::string wrong = wrong_choice(command);
    return wrong.empty() ? parser_says : wrong;
}

}  // namespace carom
