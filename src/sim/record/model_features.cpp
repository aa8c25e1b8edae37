#include "sim/record/model_features.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

namespace carom {

namespace {

/// What contacts do beyond constant coefficients: by whether materials that can meet have it.
void add_law_effects(std::map<std::string, Effect>& effects, const Scene& scene,
                     const PairTable& pairs) {
    const auto named_by = [&scene](const auto& is_named) {
        return std::any_of(scene.materials.begin(), scene.materials.end(), is_named) ||
               std::any_of(scene.pairs.begin(), scene.pairs.end(), is_named);
    };
    const auto add = [&effects](const char* name, bool named, bool on, const char* why) {
        effects[name] = on      ? Effect{true, why}
                        : named ? Effect{false, "no two things that can meet have it"}
                                : Effect{false, "no material and no pair names it"};
    };
    add("restitution_by_speed",
        named_by([](const auto& n) { return n.restitution_law.has_value(); }),
        pairs.any([](const ContactLaws& laws) { return laws.by_speed(); }),
        "coefficients depend on the approach speed of each impact");
    add("tangential_restitution",
        named_by([](const auto& n) { return n.tangential_restitution.has_value(); }),
        pairs.any([](const ContactLaws& laws) { return laws.tangential_restitution != 0; }),
        "impacts that grip reverse a part of the slip");
    add("rolling", named_by([](const auto& n) { return n.rolling.has_value(); }),
        pairs.any([](const ContactLaws& laws) { return laws.rolling > 0; }),
        "rolling is resisted: on one surface exactly, else at the end of each step");
    add("pivoting", named_by([](const auto& n) { return n.pivoting.has_value(); }),
        pairs.any([](const ContactLaws& laws) { return laws.pivoting > 0; }),
        "spin about normals is resisted: on one surface exactly, else at the end of each step");
}

}  // namespace

std::map<std::string, Effect> effects_of(const Scene& scene, const PairTable& pairs) {
    std::map<std::string, Effect> effects;
    const double g = scene.simulation.gravity.norm();
    effects["gravity"] = g > 0 ? Effect{true, fmt::format("{} m/s^2", g)}
                               : Effect{false, "simulation.gravity is [0, 0, 0]"};

    if (scene.air)
        effects["air"] = {true, fmt::format("{} kg/m^3{}", scene.air->density,
                                            scene.air->buoyancy ? "" : ", without buoyancy")};
    else
        effects["air"] = {false, "the scene names none: no drag, no lift, no buoyancy"};

    const std::size_t surfaces = scene.surfaces.size();
    effects["surfaces"] = surfaces > 0 ? Effect{true, fmt::format("the scene has {}", surfaces)}
                                       : Effect{false, "the scene has none"};

    const std::size_t balls = scene.balls.size();
    effects["pairs"] =
        balls > 1 ? Effect{true, fmt::format("the scene has {} balls, which can meet", balls)}
                  : Effect{false, "one ball at most: nothing to meet but surfaces"};

    const bool named = std::any_of(scene.materials.begin(), scene.materials.end(),
                                   [](const Material& m) { return m.friction.has_value(); }) ||
                       std::any_of(scene.pairs.begin(), scene.pairs.end(),
                                   [](const PairRule& r) { return r.friction.has_value(); });
    const bool friction = pairs.any_friction();
    effects["friction"] =
        friction ? Effect{true, "materials that can meet have it"}
        : named  ? Effect{false, "no two materials that can meet both have it: no friction rows"}
                 : Effect{false, "no material and no pair names friction: no friction rows"};

    add_law_effects(effects, scene, pairs);
    const bool spins = std::any_of(scene.balls.begin(), scene.balls.end(),
                                   [](const Ball& b) { return !b.spin.isZero(0); });
    const bool decays =
        scene.air && std::any_of(scene.balls.begin(), scene.balls.end(), [](const Ball& b) {
            return b.flight.spin_decay_s < std::numeric_limits<double>::infinity();
        });
    effects["spin"] = decays && spins ? Effect{true, "the air takes spin away"}
                      : friction      ? Effect{true, "friction turns the balls"}
                      : spins && effects.at("pivoting").on
                          ? Effect{true, "a ball spins at the start, and contacts slow that"}
                      : spins ? Effect{true, "a ball spins at the start; nothing changes its spin"}
                              : Effect{false, "no ball spins at the start, no friction turns one"};
    return effects;
}

void add_contact_effects(SimulationReport& report, bool in_free_space) {
    report.effects["islands"] =
        report.integrated + report.steps > 0
            ? Effect{true, fmt::format("contacts act on each other: {} pieces integrated, {} steps "
                                       "of ODE",
                                       report.integrated, report.steps)}
            : Effect{false, "no two lasting contacts of a ball at the same time"};
    report.effects["collapse"] =
        report.collapses > 0
            ? Effect{true, fmt::format("{} impacts on balls that had met others ever more often "
                                       "went through all that touched them at once, and did not "
                                       "rebound where they were 1000 times slower than at first",
                                       report.collapses)}
            : Effect{false, in_free_space ? "no ball met others ever more often"
                                          : "gravity presses on what comes to rest"};
    report.effects["last_resort"] =
        report.given_up > 0
            ? Effect{true, fmt::format("{} times a contact that could not be integrated, or whose "
                                       "events had no end, was stepped by ODE for a while",
                                       report.given_up)}
            : Effect{false, "no contact was given up on"};
    if (report.without_spring > 0)
        report.effects["tangential_restitution"].why += fmt::format(
            ", but for {} of a pile, which end their slip at the most", report.without_spring);
}

}  // namespace carom
