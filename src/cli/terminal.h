// What the terminal is that a person looks at.
#pragma once

namespace carom {

/// Columns of the terminal that `descriptor` leads to, as they are now; where it leads to none,
/// those of the variable COLUMNS, or 80.
int terminal_columns(int descriptor);

/// True where lines cannot be written over: TERM is "dumb", or not set.
bool is_dumb_terminal();

}  // namespace carom
