#include <carom/layers.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "api/painting.h"
#include "render/layers/layer_painter.h"
#include "report/layer_files.h"

namespace carom::v1 {

std::vector<LayerKind> layer_kinds_of(const std::vector<std::string>& names,
                                      const std::optional<SecondRun>& second) {
    std::vector<LayerKind> kinds;
    for (const std::string& name : names) {
        const LayerKindInfo* info = find_layer_kind(name);
        if (info == nullptr) {
            std::vector<std::string_view> known;
            for (const LayerKindInfo& kind : layer_kinds()) known.push_back(kind.name);
            throw Error(
                fmt::format("there is no layer '{}'; there are {}", name, fmt::join(known, ", ")));
        }
        if (std::find(kinds.begin(), kinds.end(), info->kind) != kinds.end())
            throw Error(fmt::format("the layer '{}' is named twice", name));
        kinds.push_back(info->kind);
    }
    if (!kinds.empty() && second && second->view == AgainstView::kSide)
        throw Error("two runs side by side are two pictures, which have no layers together");
    return kinds;
}

std::vector<Layer> layers(const Scene& scene, const Motion& motion, double time,
                          const std::vector<std::string>& names,
                          const std::optional<Against>& against) {
    return translated([&] {
        require_own_motion(scene, motion);
        require_instant(motion, time);
        const carom::Scene& inner = scene.impl().scene;
        const std::optional<SecondRun> second = run_to_show(scene, motion, against, {});
        const LayerSettings settings{inner.film.width_px, inner.film.height_px,
                                     layer_kinds_of(names, second), second ? &*second : nullptr};
        LayerPainter painter(inner, motion.impl().motion, settings);
        const LayerInstants instants = instants_of_still(inner.film, time, motion.duration());
        painter.paint(instants.time, instants.next, instants.previous);
        std::vector<Layer> result;
        for (const LayerKind kind : settings.kinds) {
            const LayerKindInfo& info = layer_kind_info(kind);
            Layer layer{std::string(info.name), settings.width_px, settings.height_px};
            if (info.channels.empty()) {
                layer.ids = painter.ids();
            } else {
                const FloatImage& image = painter.image(kind);
                layer.channels = image.channels;
                layer.values = image.values;
            }
            result.push_back(std::move(layer));
        }
        return result;
    });
}

}  // namespace carom::v1
