// Looks that the file declares.
#include <fmt/format.h>

#include "scene/build.h"
#include "scene/looks.h"
#include "scene/scalar.h"

namespace carom {

namespace {

int add_look(Build& build, Look look) {
    build.scene.looks.push_back(std::move(look));
    return static_cast<int>(build.scene.looks.size()) - 1;
}

}  // namespace

int default_look(Build& build, const std::string& purpose, const Look& look) {
    const auto [entry, fresh] = build.default_looks.emplace(purpose, 0);
    if (fresh) entry->second = add_look(build, look);
    return entry->second;
}

void build_looks(Build& build) {
    for (const Node& node : build.entries("looks")) {
        const Fields fields = build.fields(Section::kLook, &node);
        Look look = style_look(parse_style(fields.word("style")));
        look.name = node.key;
        if (const auto color = fields.maybe_word("color")) look.color = parse_color(*color);
        if (const auto color = fields.maybe_word("second_color"))
            look.second_color = parse_color(*color);
        look.tile_m = fields.maybe_number("tile").value_or(look.tile_m);
        look.reflection = fields.number("reflection");
        build.look_index.emplace(node.key, add_look(build, std::move(look)));
    }
}

int resolve_look(Build& build, const Node& reference) {
    const auto known = build.look_index.find(reference.text);
    if (known != build.look_index.end()) return known->second;
    std::vector<std::string> names;
    constexpr std::size_t kMostCompared = 1000;  // the names are copied for each reference
    if (build.look_index.size() <= kMostCompared && !build.report.is_full())
        for (const auto& [name, index] : build.look_index) names.push_back(name);
    std::string message = fmt::format("there is no look {}", quoted_excerpt(reference.text));
    message += names.empty() ? "; the file declares none under 'looks'"
                             : suggestion(reference.text, names);
    build.report.error(reference, std::move(message));
    return -1;
}

}  // namespace carom
