// Everything in the paper that is a result, made again: `carom figures`.
#pragma once

#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "media/output_file.h"

namespace carom {

/// One thing to make, with all its files.
struct PaperItem {
    std::string name;   ///< figure4, figure8-height, table1 ...
    std::string group;  ///< plots, tables, pictures, films
    std::vector<std::string> files;
};

/// All of them, in the paper's order.
std::vector<PaperItem> paper_items();

/// Those that `words` ask for; a word is a group, a name, or a name's part before the '-' (figure8
/// is the film, the picture, the heights ...). All, if there are none.
/// Throws Failure(kInput) for a word that fits nothing.
std::vector<PaperItem> choose_paper_items(const std::vector<std::string>& words);

/// Makes the items in `folder`, which exists; `report` is told the name of each finished file.
/// Throws Failure, also when `stop` was requested.
void make_paper(const std::vector<PaperItem>& items, const std::string& folder, Existing existing,
                const std::stop_token& stop, const std::function<void(const std::string&)>& report);

}  // namespace carom
