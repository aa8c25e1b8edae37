// The air, and how balls fly in it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/build.h"
#include "scene/catalogue.h"
#include "scene/scalar.h"

namespace carom {

namespace {

constexpr double kStandardTemperature = 15;    // degrees Celsius
constexpr double kStandardPressure = 101'325;  // Pa

std::vector<double> numbers(const Node& list) {
    std::vector<double> values;
    for (const Node& one : list.children) values.push_back(node_number(one));
    return values;
}

/// Null, and an error, where the table is none.
std::shared_ptr<const MonotoneCurve> read_table(Build& build, const Fields& fields,
                                                std::string_view over) {
    const Node *at = fields.find(over), *value = fields.find("value");
    if (at == nullptr || value == nullptr) return nullptr;
    std::vector<double> x = numbers(*at), y = numbers(*value);
    if (x.size() != y.size()) {
        build.report.error(*value, fmt::format("'{}' has {} numbers and 'value' {}: give one value "
                                               "for each",
                                               over, x.size(), y.size()));
        return nullptr;
    }
    if (x.empty()) {
        build.report.error(*at,
                           fmt::format("'{}' is empty: a table has at least one number", over));
        return nullptr;
    }
    for (std::size_t i = 1; i < x.size(); ++i)
        if (!(x[i] > x[i - 1])) {
            build.report.error(at->children[i],
                               fmt::format("'{}' must increase, and {} follows {}", over,
                                           number_text(x[i]), number_text(x[i - 1])));
            return nullptr;
        }
    return std::make_shared<const MonotoneCurve>(std::move(x), std::move(y));
}

Lift::Over lift_by_name(const std::string& name) {
    if (name == "tennis") return Lift::Over::kTennis;
    return name == "baseball" ? Lift::Over::kBaseball : Lift::Over::kSpinRatio;
}

}  // namespace

Drag read_drag(Build& build, const Fields& fields) {
    const Node& node = *fields.find("drag");
    if (node.kind == Node::Kind::kMap) {
        const Fields table = fields.child("drag");
        const bool by_speed = table.has("speed");
        if (auto curve = read_table(build, table, by_speed ? "speed" : "reynolds"))
            return {by_speed ? Drag::Over::kSpeed : Drag::Over::kReynolds, 0, std::move(curve)};
        return {};
    }
    if (node.text == "sphere") return {};
    return {Drag::Over::kNothing, node_number(node), nullptr};
}

Lift read_lift(Build& build, const Fields& fields) {
    const Node& node = *fields.find("lift");
    if (node.kind == Node::Kind::kMap) {
        if (auto curve = read_table(build, fields.child("lift"), "spin"))
            return {Lift::Over::kTable, 0, std::move(curve)};
        return {};
    }
    const std::string text = node.text;
    if (text == "spin_ratio" || text == "tennis" || text == "baseball")
        return {lift_by_name(text), 0, nullptr};
    return {Lift::Over::kNothing, node_number(node), nullptr};
}

void build_air(Build& build) {
    const Fields top = build.top();
    if (!top.has("air")) return;
    const Fields fields = top.child("air");
    Air air;
    const auto temperature = fields.maybe_number("temperature_c");
    const auto pressure = fields.maybe_number("pressure_pa");
    const auto humidity = fields.maybe_number("humidity");
    if (temperature || pressure || humidity)
        air.density = air_density(temperature.value_or(kStandardTemperature),
                                  pressure.value_or(kStandardPressure), humidity.value_or(0));
    if (temperature) air.viscosity = air_viscosity(*temperature);
    air.density = fields.maybe_number("density").value_or(air.density);
    air.viscosity = fields.maybe_number("viscosity").value_or(air.viscosity);
    air.wind = fields.vec3("wind");
    const Node* buoyancy = fields.find("buoyancy");
    air.buoyancy = buoyancy == nullptr || buoyancy->text == "true";
    if (!(air.density >= 0))
        build.report.error(*top.find("air"),
                           "at this pressure the air would hold more vapour than it has room for: "
                           "raise 'pressure_pa' or lower 'humidity'");
    build.scene.air = air;
}

void check_flights(Build& build) {
    Scene& scene = build.scene;
    for (std::size_t i = 0; i < scene.balls.size(); ++i) {
        const Ball& ball = scene.balls[i];
        const BodyOrigin& origin = build.ball_origins[i];
        const bool first_of_grid = i == 0 || build.ball_origins[i - 1].node != origin.node;
        if (!first_of_grid || origin.node == nullptr) continue;
        for (const char* key : {"drag", "lift", "spin_decay_s"})
            if (const Node* node = origin.node->find(key); node != nullptr && !scene.air)
                build.report.warning(*node, fmt::format("'{}' does nothing in a vacuum: give the "
                                                        "scene 'air'",
                                                        key));
        if (!scene.air) continue;
        const Preset* preset = find_preset(ball.preset);
        const double speed = (ball.velocity - scene.air->wind).norm();
        if (preset != nullptr && origin.node->find("drag") == nullptr &&
            speed > preset->drag_up_to_m_s)
            build.report.warning(
                *origin.node,
                fmt::format("the drag coefficient {} of '{}' is known up to {} m/s, and the ball "
                            "starts with {:.3g} m/s; give it 'drag'",
                            preset->drag, preset->name, preset->drag_up_to_m_s, speed));
        if (scene.air->buoyancy && buoyant_part(*scene.air, ball.radius, ball.mass) > 1)
            build.report.warning(*origin.node,
                                 "the ball is lighter than the air that it displaces: it rises");
    }
}

}  // namespace carom
