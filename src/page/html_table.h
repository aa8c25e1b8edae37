// Tables of pages, which scroll by themselves where they are wider or longer than their place.
#pragma once

#include <string>
#include <vector>

namespace carom {

struct HtmlColumn {
    std::string name;
    bool numeric = false;  ///< to the right
};

class HtmlTable {
  public:
    /// `caption` and names of columns are markup; `tall` ones scroll after some rows.
    HtmlTable(const char* id, std::string caption, std::vector<HtmlColumn> columns,
              bool tall = false);
    /// One cell a column, as markup; the first one names the row where `headed`.
    void row(const std::vector<std::string>& cells, bool headed = true);
    std::string text() const;

  private:
    std::string head_, rows_;
    std::vector<HtmlColumn> columns_;
};

}  // namespace carom
