#include "page/html_table.h"

#include <fmt/format.h>

#include <utility>

#include "core/check.h"

namespace carom {

HtmlTable::HtmlTable(const char* id, std::string caption, std::vector<HtmlColumn> columns,
                     bool tall)
    : columns_(std::move(columns)) {
    head_ = fmt::format(
        "<div class=\"wide{}\" role=\"region\" aria-labelledby=\"{}-title\" tabindex=\"0\">\n"
        "<table id=\"{}\"><caption id=\"{}-title\">{}</caption>\n<thead><tr>",
        tall ? " tall" : "", id, id, id, caption);
    for (const HtmlColumn& column : columns_)
        head_ += fmt::format("<th scope=\"col\"{}>{}</th>", column.numeric ? " class=\"n\"" : "",
                             column.name);
    head_ += "</tr></thead>\n<tbody>\n";
}

void HtmlTable::row(const std::vector<std::string>& cells, bool headed) {
    CAROM_CHECK(cells.size(), ==, columns_.size());
    rows_ += "<tr>";
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const bool head = headed && i == 0;
        rows_ += head ? "<th scope=\"row\">" : columns_[i].numeric ? "<td class=\"n\">" : "<td>";
        rows_ += cells[i];
        rows_ += head ? "</th>" : "</td>";
    }
    rows_ += "</tr>\n";
}

std::string HtmlTable::text() const { return head_ + rows_ + "</tbody></table></div>\n"; }

}  // namespace carom
