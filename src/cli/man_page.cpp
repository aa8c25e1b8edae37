#include "cli/man_page.h"

#include <fmt/format.h>

#include <cctype>
#include <sstream>

#include "cli/help.h"

namespace carom {

namespace {

/// A line of text that is no request and has no escape; hyphens can be copied from the page.
std::string plain(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else
            result += c;
    }
    const bool request = !result.empty() && (result.front() == '.' || result.front() == '\'');
    return request ? "\\&" + result : result;
}

/// The same of a paragraph, in lines of usual length.
std::string paragraph(const std::string& text) {
    constexpr std::size_t kWidth = 72;
    std::string result;
    std::istringstream stream(wrapped(text, 0, kWidth));
    for (std::string line; std::getline(stream, line);)
        result += (result.empty() ? "" : "\n") + plain(line);
    return result;
}

std::string examples(const std::string& lines) {
    if (lines.empty()) return "";
    std::string text = ".PP\n.EX\n";
    std::istringstream stream(lines);
    for (std::string line; std::getline(stream, line);) text += plain(line) + "\n";
    return text + ".EE\n";
}

std::string tagged(const OptionRow& option) {
    std::string names;
    for (const std::string& name : option.names)
        names += (names.empty() ? "" : ", ") + ("\\fB" + plain(name) + "\\fR");
    const std::string value = option.value.empty() ? "" : "\\fI" + plain(option.value) + "\\fR";
    const std::string between = names.empty() || value.empty() ? "" : " ";
    std::string text = option.text;
    if (!option.fallback.empty()) text += " (default: " + option.fallback + ")";
    if (option.required && !option.argument) text += " (required)";
    return fmt::format(".TP\n{}{}{}\n{}\n", names, between, value, paragraph(text));
}

std::string usage(const CommandRow& command) {
    std::string text = fmt::format("\\fBcarom {}\\fR", plain(command.path));
    for (const OptionRow& option : command.options) {
        if (option.argument) text += " \\fI" + plain(option.value) + "\\fR";
        if (option.required && !option.argument)
            text += fmt::format(" \\fB{}\\fR \\fI{}\\fR", plain(option.names.front()),
                                plain(option.value));
    }
    return text + (command.subcommands.empty() ? " [options]" : " \\fIcommand\\fR ...");
}

std::string section(const CommandRow& command) {
    std::string text = fmt::format(".SS carom {}\n{}\n.PP\n{}\n", plain(command.path),
                                   usage(command), paragraph(command.text));
    text += examples(command.examples);
    for (const OptionRow& option : command.options) text += tagged(option);
    return text;
}

constexpr const char* kEnd = R"(.SH EXIT STATUS
.TP
0
done, also when the reader of a pipe has gone
.TP
1
failed while running, e.g. an encoder that FFmpeg lacks
.TP
2
wrong usage, or an input file that is missing or unreadable
.TP
3
the scene is invalid
.TP
4
output could not be written, or exists and \fB\-y\fR was not given
.TP
5
\fBcompare\fR or \fBgolden\fR found a difference, or there was no golden
.TP
128 + n
interrupted by signal n
.SH ENVIRONMENT
.TP
COLUMNS
the width of help where it goes to no terminal
.TP
TERM
a dumb one gets lines instead of a bar of progress
.TP
TMPDIR
where temporary files go that belong beside no output
.SH SEE ALSO
.BR ffmpeg (1),
.BR gnuplot (1)
)";

}  // namespace

std::string man_page(const std::vector<CommandRow>& table, const std::string& version,
                     const std::string& date) {
    const CommandRow& program = table.front();
    // The first letter of a NAME line is small, and it has no stop.
    std::string purpose = program.text.substr(0, program.text.find_last_not_of('.') + 1);
    if (!purpose.empty()) purpose.front() = static_cast<char>(std::tolower(purpose.front()));
    std::string text = fmt::format(
        ".TH CAROM 1 {} \"carom {}\" \"User Commands\"\n.SH NAME\ncarom \\- {}\n"
        ".SH SYNOPSIS\n.B carom\n.I command\n[options] ...\n.SH DESCRIPTION\n"
        "carom reads a scene of bouncing balls from a YAML file, finds their\nmotion, and draws "
        "it: "
        "films, pictures, numbers. A scene \\(lq\\-\\(rq is\nstandard input. Data goes to standard "
        "output, everything else to\nstandard error.\n",
        date, plain(version), paragraph(purpose));
    text += examples(program.examples);
    for (const OptionRow& option : program.options) text += tagged(option);
    text += ".SH COMMANDS\n";
    for (const CommandRow& command : table)
        if (!command.path.empty()) text += section(command);
    return text + kEnd;
}

}  // namespace carom
