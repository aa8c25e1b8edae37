#include "scene_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <optional>
#include <variant>

namespace carom::bench {

namespace {

std::string text(const Vec3& v) { return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z()); }

std::string shape_text(const PlaneShape& plane) {
    return fmt::format("plane: {{normal: {}, offset: {}}}", text(plane.normal), plane.offset_m);
}

std::string shape_text(const BoxShape& box) {
    std::string turned;
    const Quat& q = box.orientation;
    if (!q.vec().isZero(0))
        turned = fmt::format(", quaternion: [{}, {}, {}, {}]", q.w(), q.x(), q.y(), q.z());
    return fmt::format("box: {{position: {}, size: {}{}}}", text(box.center), text(box.size),
                       turned);
}

std::string shape_text(const SphereShape& sphere) {
    return fmt::format("sphere: {{position: {}, radius: {}}}", text(sphere.center), sphere.radius);
}

std::string shape_text(const CapsuleShape& capsule) {
    return fmt::format("capsule: {{from: {}, to: {}, radius: {}}}", text(capsule.from),
                       text(capsule.to), capsule.radius);
}

std::string shape_text(const CylinderShape& cylinder) {
    return fmt::format("cylinder: {{from: {}, to: {}, radius: {}}}", text(cylinder.from),
                       text(cylinder.to), cylinder.radius);
}

std::string shape_text(const RingShape& ring) {
    return fmt::format("ring: {{position: {}, axis: {}, radius: {}, tube_radius: {}}}",
                       text(ring.center), text(ring.axis), ring.radius, ring.tube_radius);
}

std::string shape_text(const BowlShape& bowl) {
    return fmt::format("bowl: {{position: {}, radius: {}, opening: {}, depth: {}}}",
                       text(bowl.center), bowl.radius, text(bowl.opening), bowl.depth);
}

std::string shape_text(const PipeShape& pipe) {
    const double degrees = pipe.is_tube() ? 360 : pipe.angle * (180 / M_PI);
    return fmt::format("pipe: {{from: {}, to: {}, radius: {}, opening: {}, angle_deg: {}}}",
                       text(pipe.from), text(pipe.to), pipe.radius, text(pipe.opening), degrees);
}

std::string law_text(const MonotoneCurve& curve) {
    return fmt::format("speed: [{}], value: [{}]", fmt::join(curve.x(), ", "),
                       fmt::join(curve.y(), ", "));
}
std::string law_text(const PowerRestitution& power) {
    return fmt::format("power: {{value: {}, at_speed: {}, exponent: {}}}", power.value,
                       power.at_speed, power.exponent);
}
std::string law_text(const ViscoelasticRestitution& law) {
    return fmt::format("viscoelastic: {{gamma: {}}}", law.gamma);
}

/// What materials and pairs share, each entry after a comma.
template <class Named>
std::string contact_text(const Named& named) {
    std::string all;
    const auto add = [&all](const char* key, const std::optional<double>& value) {
        if (value) all += fmt::format(", {}: {}", key, *value);
    };
    if (named.restitution_law)
        all += fmt::format(
            ", restitution: {{{}}}",
            std::visit([](const auto& law) { return law_text(law); }, *named.restitution_law));
    add("friction", named.friction);
    add("rolling", named.rolling);
    add("pivoting", named.pivoting);
    add("tangential_restitution", named.tangential_restitution);
    return all;
}

std::string materials_text(const Scene& scene) {
    std::string all;
    for (std::size_t i = 1; i < scene.materials.size(); ++i) {
        const Material& m = scene.materials[i];
        const VirtualBody& body = m.virtual_body;
        all += fmt::format("  {}: {{", m.name);
        if (m.restitution_law)
            all += contact_text(m).substr(2);
        else if (std::isinf(body.distance_m))
            all += "restitution: 0";
        else if (body.distance_m == 0)
            all += "restitution: 1";
        else
            all += fmt::format("virtual_body: {{distance: {}, velocity: {}}}", body.distance_m,
                               body.velocity_m_s);
        if (!m.restitution_law) all += contact_text(m);
        all += "}\n";
    }
    return all.empty() ? all : "materials:\n" + all;
}

std::string pairs_text(const Scene& scene) {
    std::string all;
    for (const PairRule& pair : scene.pairs) {
        all += fmt::format("  - {{between: [{}, {}]", scene.materials.at(pair.between[0]).name,
                           scene.materials.at(pair.between[1]).name);
        if (pair.restitution) all += fmt::format(", restitution: {}", *pair.restitution);
        all += contact_text(pair) + "}\n";
    }
    return all.empty() ? all : "pairs:\n" + all;
}

std::string material_key(const Scene& scene, int material) {
    return material == 0 ? ""
                         : fmt::format(", material: {}",
                                       scene.materials[static_cast<std::size_t>(material)].name);
}

template <class List>
std::string list_text(const List& numbers) {
    return fmt::format("[{}]", fmt::join(numbers, ", "));
}

std::string air_text(const Scene& scene) {
    if (!scene.air) return "";
    const Air& air = *scene.air;
    return fmt::format("air: {{density: {}, viscosity: {}, wind: {}, buoyancy: {}}}\n", air.density,
                       air.viscosity, text(air.wind), air.buoyancy);
}

std::string flight_text(const Flight& flight) {
    const Drag& drag = flight.drag;
    const Lift& lift = flight.lift;
    std::string all;
    if (drag.over == Drag::Over::kSpeed || drag.over == Drag::Over::kReynolds)
        all += fmt::format(", drag: {{{}: {}, value: {}}}",
                           drag.over == Drag::Over::kSpeed ? "speed" : "reynolds",
                           list_text(drag.table->x()), list_text(drag.table->y()));
    else if (drag.over == Drag::Over::kNothing)
        all += fmt::format(", drag: {}", drag.constant);
    if (lift.over == Lift::Over::kTable)
        all += fmt::format(", lift: {{spin: {}, value: {}}}", list_text(lift.table->x()),
                           list_text(lift.table->y()));
    else if (lift.over == Lift::Over::kNothing)
        all += fmt::format(", lift: {}", lift.constant);
    else
        all += fmt::format(", lift: {}", lift.over == Lift::Over::kSpinRatio ? "spin_ratio"
                                         : lift.over == Lift::Over::kTennis  ? "tennis"
                                                                             : "baseball");
    if (std::isfinite(flight.spin_decay_s))
        all += fmt::format(", spin_decay_s: {}", flight.spin_decay_s);
    return all;
}

std::string ball_text(const Scene& scene, const Ball& b) {
    std::string line =
        fmt::format("  - {{name: {}, radius: {}, mass: {}, inertia: {}{}, ", b.name, b.radius,
                    b.mass, b.inertia_factor, material_key(scene, b.material));
    line += fmt::format("position: {}", text(b.position));
    if (!b.velocity.isZero(0)) line += fmt::format(", velocity: {}", text(b.velocity));
    if (!b.spin.isZero(0)) line += fmt::format(", spin: {}", text(b.spin));
    if (scene.air) line += flight_text(b.flight);
    return line + "}\n";
}

}  // namespace

std::string scene_text(const Scene& scene) {
    const Simulation& s = scene.simulation;
    std::string all = fmt::format("carom: 1\nsimulation: {{duration: {}, gravity: {}",
                                  s.duration.value_or(s.max_duration), text(s.gravity));
    if (s.restitution_constant != Simulation{}.restitution_constant)
        all += fmt::format(", restitution_constant: {}", s.restitution_constant);
    all += "}\n" + air_text(scene) + materials_text(scene) + pairs_text(scene);
    if (!scene.surfaces.empty()) all += "surfaces:\n";
    for (const Surface& surface : scene.surfaces)
        all += fmt::format(
            "  - {{name: {}, {}{}}}\n", surface.name,
            std::visit([](const auto& shape) { return shape_text(shape); }, surface.shape),
            material_key(scene, surface.material));
    if (!scene.balls.empty()) all += "balls:\n";
    for (const Ball& ball : scene.balls) all += ball_text(scene, ball);
    return all;
}

}  // namespace carom::bench
