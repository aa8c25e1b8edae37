#include "report/run_json.h"

#include <nlohmann/json.hpp>

namespace carom {

nlohmann::ordered_json effects_json(const std::map<std::string, Effect>& effects) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const auto& [name, effect] : effects)
        json[name] = {{"on", effect.on}, {"why", effect.why}};
    return json;
}

nlohmann::ordered_json peaks_json(const Motion& motion) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < motion.ball_names.size(); ++i) {
        nlohmann::ordered_json peaks = nlohmann::ordered_json::array();
        for (const Peak& peak : motion.peaks[i])
            peaks.push_back({{"time", peak.time}, {"height", peak.height}});
        json[motion.ball_names[i]] = {{"peaks", std::move(peaks)}};
    }
    return json;
}

}  // namespace carom
