// The manual page, made from the parser's own tables.
#pragma once

#include <string>
#include <vector>

#include "cli/command_table.h"

namespace carom {

/// carom(1) as man(7) takes it. `date` is that of the version, YYYY-MM-DD.
std::string man_page(const std::vector<CommandRow>& table, const std::string& version,
                     const std::string& date);

}  // namespace carom
