// Completions for shells, made from the parser's own tables.
#pragma once

#include <string>
#include <vector>

#include "cli/command_table.h"

namespace carom {

/// What a shell may complete a value with.
enum class ValueKind {
    kText,    ///< nothing
    kChoice,  ///< one of OptionRow::choices
    kScene,   ///< files that end in .yaml or .yml
    kFile,
    kFolder,
};
ValueKind value_kind(const OptionRow& option);

/// The kind of a command's arguments; kText where it has none.
ValueKind argument_kind(const CommandRow& command);

std::string bash_completion(const std::vector<CommandRow>& table);
std::string zsh_completion(const std::vector<CommandRow>& table);
std::string fish_completion(const std::vector<CommandRow>& table);

/// The same in single quotes, for any shell.
std::string shell_quoted(const std::string& text);

}  // namespace carom
