// The line of a file that a message is about, with a mark under the place.
#pragma once

#include <string>
#include <string_view>

#include "core/diagnostics.h"

namespace carom {

/// The first line of a text, without its end. Lines end by LF, CR LF or CR; a byte order mark
/// belongs to none.
std::string_view first_line(std::string_view text);

/// What follows behind the first line and its end.
std::string_view after_first_line(std::string_view text);

/// Two lines, each with an end: the number and the line, and a caret under the character that
/// `mark` names, with the word that begins there underlined:
///
///     3 | bals: []
///       | ^~~~
///
/// What could move the cursor is shown as '?', a tab as a blank; of a long line the part around the
/// place. "" where the line is empty or the place unknown.
std::string excerpt(std::string_view line, SourceMark mark);

}  // namespace carom
