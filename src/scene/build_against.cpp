// The second run of a film.
#include <fmt/format.h>

#include "scene/build.h"
#include "scene/scalar.h"

namespace carom {

void build_against(Build& build) {
    const Node* node = build.root.find("against");
    if (node == nullptr || node->kind != Node::Kind::kMap) return;
    const Fields fields = build.top().child("against");
    Against against;
    against.scene = fields.maybe_word("scene").value_or("");
    if (const Node* scene = fields.find("scene"); scene != nullptr && against.scene.empty())
        build.report.error(*scene, "'scene' must name a scene file");
    if (const Node* set = fields.find("set")) {
        if (set->children.empty() && against.scene.empty())
            build.report.error(*set, "nothing is set, so that both runs are the same");
        for (const Node& entry : set->children) {
            if (entry.text.find('=') == std::string::npos || entry.text[0] == '=')
                build.report.error(entry, fmt::format("{} is not PATH=VALUE, such as "
                                                      "\"simulation.method=fixed\"",
                                                      quoted_excerpt(entry.text)));
            against.set.push_back(entry.text);
        }
    }
    const bool side = fields.word("view") == "side";
    against.view = side ? AgainstView::kSide : AgainstView::kGhost;
    build.scene.against = std::move(against);
}

}  // namespace carom
