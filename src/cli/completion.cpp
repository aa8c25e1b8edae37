#include "cli/completion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace carom {

ValueKind value_kind(const OptionRow& option) {
    const std::string& value = option.value;
    const auto has = [&value](const char* part) { return value.find(part) != std::string::npos; };
    if (value.empty()) return ValueKind::kText;
    if (!option.choices.empty()) return ValueKind::kChoice;
    if (has("DIR")) return ValueKind::kFolder;
    if (has("SCENE") || has(".yaml")) return ValueKind::kScene;
    if (has("NAME")) return ValueKind::kText;
    if (has("FILE") || has("OUT") || has("PLOT")) return ValueKind::kFile;
    // REPORT.json, D.png: a name with an extension.
    const std::size_t dot = value.find('.');
    if (dot != std::string::npos && dot > 0 && dot + 1 < value.size() && value[dot + 1] >= 'a' &&
        value[dot + 1] <= 'z')
        return ValueKind::kFile;
    return option.argument ? ValueKind::kFile : ValueKind::kText;
}

ValueKind argument_kind(const CommandRow& command) {
    for (const OptionRow& option : command.options)
        if (option.argument) return value_kind(option);
    return ValueKind::kText;
}

std::string shell_quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) {
        if (c == '\'')
            result += "'\\''";
        else
            result += c;
    }
    return result + "'";
}

namespace {

/// The path without its last word, and that word.
std::pair<std::string, std::string> parent_and_name(const std::string& path) {
    const std::size_t blank = path.rfind(' ');
    if (blank == std::string::npos) return {"", path};
    return {path.substr(0, blank), path.substr(blank + 1)};
}

const char* kind_word(ValueKind kind) {
    switch (kind) {
        case ValueKind::kScene:
            return "scene";
        case ValueKind::kFile:
            return "file";
        case ValueKind::kFolder:
            return "folder";
        case ValueKind::kText:
        case ValueKind::kChoice:
            break;
    }
    return "";
}

/// What stands where neither an option nor its value does.
std::string bash_command_case(const CommandRow& command) {
    std::vector<std::string> names, words = command.subcommands;
    for (const OptionRow& option : command.options) {
        names.insert(names.end(), option.names.begin(), option.names.end());
        if (option.argument)
            words.insert(words.end(), option.choices.begin(), option.choices.end());
    }
    return fmt::format("        {}) options={} words={} kind={} ;;\n", shell_quoted(command.path),
                       shell_quoted(fmt::format("{}", fmt::join(names, " "))),
                       shell_quoted(fmt::format("{}", fmt::join(words, " "))),
                       kind_word(argument_kind(command)));
}

std::string bash_value_case(const CommandRow& command, const OptionRow& option) {
    std::vector<std::string> patterns;
    for (const std::string& name : option.names)
        patterns.push_back(shell_quoted(command.path + ":" + name));
    return fmt::format("        {}) options= words={} kind={} ;;\n", fmt::join(patterns, " | "),
                       shell_quoted(fmt::format("{}", fmt::join(option.choices, " "))),
                       kind_word(value_kind(option)));
}

}  // namespace

std::string bash_completion(const std::vector<CommandRow>& table) {
    std::string paths, commands, values;
    for (const CommandRow& command : table) {
        const auto [parent, name] = parent_and_name(command.path);
        if (!command.path.empty())
            paths += fmt::format("            {}) command={} ;;\n",
                                 shell_quoted(parent + "/" + name), shell_quoted(command.path));
        commands += bash_command_case(command);
        for (const OptionRow& option : command.options)
            if (!option.argument && !option.value.empty())
                values += bash_value_case(command, option);
    }
    return fmt::format(R"(# Completion of carom for bash; `carom completion bash` makes it.
_carom() {{
    local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}}
    local command= options= words= kind= i
    COMPREPLY=()
    # bash takes "--option=value" apart at the sign.
    if [[ $current == = ]]; then
        current=
    elif [[ $previous == = ]]; then
        previous=${{COMP_WORDS[COMP_CWORD - 2]}}
    fi
    for ((i = 1; i < COMP_CWORD; i++)); do
        case $command/${{COMP_WORDS[i]}} in
{}        esac
    done
    case $command in
{}    esac
    case $command:$previous in
{}    esac
    [[ $current == -* ]] && words=$options kind=
    mapfile -t COMPREPLY < <(
        compgen -W "$words" -- "$current"
        case $kind in
            scene) compgen -f -X '!*.yaml' -- "$current"; compgen -f -X '!*.yml' -- "$current"; compgen -d -- "$current" ;;
            file) compgen -f -- "$current" ;;
            folder) compgen -d -- "$current" ;;
        esac
    )
    [[ -z $kind ]] || compopt -o filenames 2>/dev/null
}}
complete -F _carom carom
)",
                       paths, commands, values);
}

namespace {

std::string zsh_action(const OptionRow& option) {
    switch (value_kind(option)) {
        case ValueKind::kChoice:
            return fmt::format("({})", fmt::join(option.choices, " "));
        case ValueKind::kScene:
            return "_files -g \"*.(yaml|yml)\"";
        case ValueKind::kFile:
            return "_files";
        case ValueKind::kFolder:
            return "_files -/";
        case ValueKind::kText:
            break;
    }
    return " ";
}

/// Text where `marks` end it.
std::string zsh_escaped(const std::string& text, const std::string& marks) {
    std::string result;
    for (const char c : text) {
        if (c == '\\' || marks.find(c) != std::string::npos) result += '\\';
        result += c;
    }
    return result;
}

std::string zsh_option(const OptionRow& option) {
    const std::string value = zsh_escaped(option.value, ":");
    if (option.argument)
        return " \\\n            " +
               shell_quoted(fmt::format("*:{}:{}", value, zsh_action(option)));
    std::string specs;
    for (const std::string& name : option.names) {
        std::string spec = fmt::format(
            "*{}{}[{}]", name, option.value.empty() ? "" : (name.starts_with("--") ? "=" : "+"),
            zsh_escaped(option.text, "[]"));
        if (!option.value.empty()) spec += fmt::format(":{}:{}", value, zsh_action(option));
        specs += " \\\n            " + shell_quoted(spec);
    }
    return specs;
}

std::string zsh_list(const std::vector<CommandRow>& table, const CommandRow& of) {
    std::string list;
    for (const CommandRow& command : table) {
        const auto [parent, name] = parent_and_name(command.path);
        if (!command.path.empty() && parent == of.path)
            list += " " + shell_quoted(zsh_escaped(name, ":") + ":" + command.text);
    }
    return list;
}

}  // namespace

std::string zsh_completion(const std::vector<CommandRow>& table) {
    std::string groups, cases;
    for (const CommandRow& command : table) {
        if (!command.path.empty() && !command.subcommands.empty())
            groups += fmt::format(
                "        {0})\n            if (( CURRENT == 3 )); then\n                "
                "commands=({1})\n                _describe -t commands command commands\n"
                "                return\n            fi\n            name=\"{0} $words[3]\"\n"
                "            shift words; (( CURRENT-- )) ;;\n",
                command.path, zsh_list(table, command));
        std::string options;
        for (const OptionRow& option : command.options) options += zsh_option(option);
        cases +=
            fmt::format("        {}) _arguments -S{} ;;\n", shell_quoted(command.path), options);
    }
    return fmt::format(R"(#compdef carom
# Completion of carom for zsh; `carom completion zsh` makes it.
_carom() {{
    local -a commands
    if (( CURRENT == 2 )) && [[ $words[2] != -* ]]; then
        commands=({})
        _describe -t commands command commands
        return
    fi
    local name=$words[2]
    [[ $name != -* ]] || name=
    case $name in
{}    esac
    if [[ -n $name ]]; then
        shift words; (( CURRENT-- ))
    fi
    case $name in
{}    esac
}}
if [[ $funcstack[1] == _carom ]]; then
    _carom "$@"
else
    compdef _carom carom
fi
)",
                       zsh_list(table, table.front()), groups, cases);
}

namespace {

/// The options of fish's `complete` for one of ours.
std::string fish_option(const OptionRow& option) {
    std::string line;
    for (const std::string& name : option.names)
        line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    if (option.value.empty()) return line;
    line += " -r";
    switch (value_kind(option)) {
        case ValueKind::kChoice:
            return line + " -f -a " +
                   shell_quoted(fmt::format("{}", fmt::join(option.choices, " ")));
        case ValueKind::kScene:
        case ValueKind::kFile:
            return line + " -F";
        case ValueKind::kFolder:
            return line + " -f -a '(__fish_complete_directories)'";
        case ValueKind::kText:
            break;
    }
    return line + " -f";
}

/// In fish's single quotes only a backslash and the quote itself are special.
std::string fish_quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) {
        if (c == '\'' || c == '\\') result += '\\';
        result += c;
    }
    return result + "'";
}

std::string fish_arguments(const OptionRow& option) {
    switch (value_kind(option)) {
        case ValueKind::kChoice:
            return " -f -a " + shell_quoted(fmt::format("{}", fmt::join(option.choices, " ")));
        case ValueKind::kScene:
            return " -f -a '(__fish_complete_suffix .yaml)'";
        case ValueKind::kFolder:
            return " -f -a '(__fish_complete_directories)'";
        case ValueKind::kFile:
            return " -F";
        case ValueKind::kText:
            break;
    }
    return " -f";
}

}  // namespace

std::string fish_completion(const std::vector<CommandRow>& table) {
    std::string paths, lines;
    for (const CommandRow& command : table) {
        const auto [parent, name] = parent_and_name(command.path);
        const auto at = [](const std::string& path) {
            return fmt::format(
                "complete -c carom -n {}",
                fish_quoted(fmt::format("test \"$(__carom_command)\" = \"{}\"", path)));
        };
        if (!command.path.empty()) {
            paths += fmt::format("            case {}\n                set path {}\n",
                                 fish_quoted(parent + "/" + name), fish_quoted(command.path));
            lines +=
                fmt::format("{} -f -a {} -d {}\n", at(parent), name, fish_quoted(command.text));
        }
        for (const OptionRow& option : command.options)
            lines += at(command.path) +
                     (option.argument ? fish_arguments(option)
                                      : fish_option(option) + " -d " + fish_quoted(option.text)) +
                     "\n";
    }
    return fmt::format(R"(# Completion of carom for fish; `carom completion fish` makes it.
function __carom_command
    set -l path ''
    for word in (commandline -opc)[2..]
        switch "$path/$word"
{}        end
    end
    echo "$path"
end
complete -c carom -f
{})",
                       paths, lines);
}

}  // namespace carom
