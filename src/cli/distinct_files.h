// No output of a command may be another one, or what the command reads.
#pragma once

#include <string>
#include <vector>

namespace carom {

/// A file that a command reads or writes, and the option that names it. "-" is standard input or
/// output, an empty path no file.
struct NamedFile {
    std::string option;
    std::string path;
};

/// Throws Failure(kInput) where two outputs are one file, or an output is an input: under whatever
/// name, through links too. /dev/null may be named as often as one likes. Before any work.
void require_distinct(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs);

/// True if both paths lead to one file, also to one that does not exist yet.
bool are_one_file(const std::string& a, const std::string& b);

}  // namespace carom
