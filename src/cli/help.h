// --help: made from the same table that the parser works by, as wide as the terminal.
#pragma once

#include <cstddef>
#include <string>

namespace CLI {
class App;
}

namespace carom {

/// What holds for every command that is added to `app` afterwards: how its help looks, and that the
/// last of a repeated option counts.
void set_up_help(CLI::App& app);

/// The help of the command that the command line has named, or of `app`.
std::string help_text(const CLI::App& app);

/// What was wrong with a command line: the parser's words, or the unknown word with the nearest one
/// that there is. `argument` is the command line's first word, "" if it has none.
std::string usage_error(const CLI::App& app, const std::string& parser_says,
                        const std::string& argument);

/// `text` in lines of at most `width` characters, broken between words; all but the first begin
/// with `indent` spaces. A word that is longer stands alone.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t width);

}  // namespace carom
