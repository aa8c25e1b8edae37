#include "scene/catalogue.h"

#include <array>
#include <numbers>

namespace carom {

namespace {

constexpr double radius_of_circumference(double circumference_m) {
    return circumference_m / (2 * std::numbers::pi);
}

constexpr double middle(double low, double high) { return (low + high) / 2; }

/// All five are hollow with a wall that is thin against the radius, so the thin shell's 2/3 is
/// nearest. A tennis ball's rubber and felt are about a fifth of its radius, which makes its true
/// factor a little smaller.
constexpr double kThinShell = 2.0 / 3.0;

constexpr std::array<Preset, 5> kCatalogue = {{
    {.name = "basketball",
     .radius = radius_of_circumference(middle(0.749, 0.780)),
     .mass = middle(0.567, 0.650),
     .inertia_factor = kThinShell,
     .virtual_body = {0.42, 5},
     .printed_restitution = 0.85,
     .style = LookStyle::kBasketball,
     .drag = 0.50,
     .drag_up_to_m_s = 15,
     .radius_source = "middle of the circumference 0.749-0.780 m",
     .mass_source = "middle of 567-650 g (FIBA)",
     .restitution_source = "Table 2; drop 1.8 m, rebound 1.30 m (printed 0.13)",
     .drag_source = "about 0.5 below the drag crisis (Okubo & Hubbard 2006)"},
    {.name = "volleyball",
     .radius = radius_of_circumference(middle(0.65, 0.67)),
     .mass = middle(0.260, 0.280),
     .inertia_factor = kThinShell,
     .virtual_body = {0.72, 6},
     .printed_restitution = 0.78,
     .style = LookStyle::kVolleyball,
     .drag = 0.47,
     .drag_up_to_m_s = 18,
     .radius_source = "middle of the circumference 65-67 cm",
     .mass_source = "middle of 260-280 g",
     .restitution_source = "Table 2; drop 1.0 m, rebound 0.60-0.66 m",
     .drag_source =
         "below the drag crisis, which begins at a Reynolds number of 2.6e5 (Hong, Ozaki, "
         "Watanabe, Asai 2020)"},
    {.name = "football",
     .radius = radius_of_circumference(middle(0.685, 0.695)),
     .mass = middle(0.420, 0.445),
     .inertia_factor = kThinShell,
     .virtual_body = {0.3, 3},
     .printed_restitution = 0.81,
     .style = LookStyle::kFootball,
     .drag = 0.50,
     .drag_up_to_m_s = 9,
     .radius_source = "middle of the circumference 68.5-69.5 cm",
     .mass_source = "middle of 420-445 g (FIFA, size 5)",
     .restitution_source = "Table 2; drop 2.0 m, rebound 1.20-1.65 m (1.20 printed as 0.12)",
     .drag_source = "0.4996 at 5 m/s, falling from some 9 m/s on (Goff & Carre 2010)"},
    {.name = "tennis",
     .radius = middle(0.06541, 0.06858) / 2,
     .mass = middle(0.0560, 0.0594),
     .inertia_factor = kThinShell,
     .virtual_body = {0.736, 5},
     .printed_restitution = 0.745,
     .style = LookStyle::kTennis,
     .drag = 0.507,
     .drag_up_to_m_s = 60,
     .radius_source = "half the middle of the diameter 65.41-68.58 mm",
     .mass_source = "middle of 56-59.4 g",
     .restitution_source = "not in Table 2; chosen for 0.745, the middle of Table 1's 0.73-0.76 "
                           "(drop 2.54 m, rebound 1.346-1.473 m)",
     .drag_source = "0.507 at all speeds of play (Cross & Lindsey 2013)"},
    {.name = "table_tennis",
     .radius = 0.040 / 2,
     .mass = 0.0027,
     .inertia_factor = kThinShell,
     .virtual_body = {0.05, 1},
     .printed_restitution = 0.9,
     .style = LookStyle::kTableTennis,
     .drag = 0.45,
     .drag_up_to_m_s = 33,
     .radius_source = "half the diameter 40 mm",
     .mass_source = "2.7 g",
     .restitution_source = "Table 2; drop 0.305 m, rebound 0.24-0.26 m",
     .drag_source = "0.4 to 0.5 up to a Reynolds number of 9e4 (French; Miyazaki et al. 2017)"},
}};

}  // namespace

std::span<const Preset> catalogue() { return kCatalogue; }

const Preset* find_preset(std::string_view name) {
    for (const Preset& preset : kCatalogue)
        if (preset.name == name) return &preset;
    return nullptr;
}

std::vector<std::string> preset_names() {
    std::vector<std::string> names;
    for (const Preset& preset : kCatalogue) names.emplace_back(preset.name);
    return names;
}

}  // namespace carom
