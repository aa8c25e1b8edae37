// Balls: own keys, presets, defaults, and grids of equal ones.
#include <fmt/format.h>

#include <optional>

#include "scene/build.h"
#include "scene/catalogue.h"
#include "scene/looks.h"
#include "scene/repeat.h"
#include "scene/scalar.h"

namespace carom {

namespace {

constexpr double kMostBalls = 1e6;
constexpr double kLargestCoordinate = 1e9;  ///< m, as in the table of keys

/// Keys of a ball, or of defaults.ball, and the preset that stands among them.
struct Layer {
    Fields fields;
    const Node* map = nullptr;
    const Preset* preset = nullptr;

    /// Also true where the value is wrong: then its mistake is reported already.
    bool mentions(std::string_view key) const {
        return map != nullptr && map->find(key) != nullptr;
    }
};

Layer read_layer(Build& build, Section section, const Node* map) {
    Layer layer{build.fields(section, map), map, nullptr};
    const Node* node = layer.fields.find("preset");
    if (node == nullptr) return layer;
    layer.preset = find_preset(node->text);
    if (layer.preset == nullptr)
        build.report.error(*node, fmt::format("there is no preset {}{}", quoted_excerpt(node->text),
                                              suggestion(node->text, preset_names())));
    return layer;
}

const Node* defaults_map(const Build& build) {
    const Node* defaults = build.root.find("defaults");
    const Node* ball = defaults == nullptr ? nullptr : defaults->find("ball");
    return ball != nullptr && ball->kind == Node::Kind::kMap ? ball : nullptr;
}

double inertia_of(const Node& node) {
    if (node.text == "solid") return 2.0 / 5.0;
    if (node.text == "shell") return 2.0 / 3.0;
    return node_number(node);
}

/// Builds the balls of one scene. What a ball has comes from the first of these that says it: its
/// own keys, its preset, the keys of defaults.ball, the preset of defaults.ball, the table of keys.
class BallBuilder {
  public:
    explicit BallBuilder(Build& build)
        : build_(build), defaults_(read_layer(build, Section::kBallDefaults, defaults_map(build))) {
        if (const Node* node = defaults_.fields.find("material"))
            default_material_ = resolve_material(build_, *node);
        if (const Node* node = defaults_.fields.find("look"))
            default_look_ = resolve_look(build_, *node);
    }

    void add(const Node& node);

  private:
    /// From a key or a preset; empty if nobody says it, or if who says it is wrong.
    std::optional<double> settle(const Layer& own, std::string_view key,
                                 double Preset::*member) const;
    Vec3 start_vector(const Layer& own, std::string_view key) const;
    int material(const Layer& own);
    int look(const Layer& own, const Node* own_look);
    Flight flight(const Layer& own);
    bool place(const Layer& own, Ball& ball);
    bool fits_limits(const Fields& repeat, const Node& node, const Ball& ball);
    std::vector<Ball> unroll(const Layer& own, const Ball& ball, bool& sound);

    Build& build_;
    Layer defaults_;
    int default_material_ = -1;
    int default_look_ = -1;
    double asked_for_ = 0;  ///< balls so far; a double, because counts multiply
};

std::optional<double> BallBuilder::settle(const Layer& own, std::string_view key,
                                          double Preset::*member) const {
    for (const Layer* layer : {&own, &defaults_}) {
        if (layer->mentions(key)) {
            const Node* node = layer->fields.find(key);
            if (node == nullptr) return std::nullopt;
            return key == "inertia" ? inertia_of(*node) : node_number(*node);
        }
        if (layer->preset != nullptr) return layer->preset->*member;
        if (layer->mentions("preset")) return std::nullopt;
    }
    return std::nullopt;
}

Vec3 BallBuilder::start_vector(const Layer& own, std::string_view key) const {
    const bool from_defaults = !own.fields.has(key) && defaults_.fields.has(key);
    return from_defaults ? defaults_.fields.vec3(key) : own.fields.vec3(key);
}

int BallBuilder::material(const Layer& own) {
    if (const Node* node = own.fields.find("material")) return resolve_material(build_, *node);
    if (own.preset != nullptr) return preset_material(build_, std::string(own.preset->name));
    if (default_material_ >= 0) return default_material_;
    if (defaults_.preset != nullptr)
        return preset_material(build_, std::string(defaults_.preset->name));
    return 0;
}

/// Of the next ball of the scene. Plain colours change from ball to ball, also within `repeat`.
int BallBuilder::look(const Layer& own, const Node* own_look) {
    if (own_look != nullptr) {
        const auto known = build_.look_index.find(own_look->text);
        if (known != build_.look_index.end()) return known->second;
    }
    const Preset* preset = own.preset;
    if (preset == nullptr && default_look_ >= 0) return default_look_;
    if (preset == nullptr) preset = defaults_.preset;
    if (preset != nullptr)
        return default_look(build_, std::string(preset->name), style_look(preset->style));
    const int color = static_cast<int>(build_.scene.balls.size() % kPaletteSize);
    return default_look(build_, fmt::format("palette {}", color), palette_look(color));
}

Flight BallBuilder::flight(const Layer& own) {
    Flight flight;
    bool has_drag = false, has_lift = false, decays = false;
    for (const Layer* layer : {&own, static_cast<const Layer*>(&defaults_)}) {
        if (!has_drag && layer->fields.has("drag")) {
            flight.drag = read_drag(build_, layer->fields);
            has_drag = true;
        }
        if (!has_drag && layer->preset != nullptr) {
            flight.drag = {Drag::Over::kNothing, layer->preset->drag, nullptr};
            has_drag = true;
        }
        if (!has_lift && layer->fields.has("lift")) {
            flight.lift = read_lift(build_, layer->fields);
            has_lift = true;
        }
        if (const auto decay = layer->fields.maybe_number("spin_decay_s"); decay && !decays) {
            flight.spin_decay_s = *decay;
            decays = true;
        }
    }
    return flight;
}

/// Radius and position; false where they are not known.
bool BallBuilder::place(const Layer& own, Ball& ball) {
    const auto mentioned = [&](std::string_view key) {
        return own.mentions(key) || defaults_.mentions(key);
    };
    const std::optional<double> radius = settle(own, "radius", &Preset::radius);
    if (!radius && !mentioned("radius") && !mentioned("preset"))
        build_.report.error(*own.map, "the ball has no radius; give it 'radius' or 'preset'");
    ball.radius = radius.value_or(ball.radius);

    if (own.mentions("position")) {
        if (!own.fields.has("position")) return false;
        ball.position = own.fields.vec3("position");
        return radius.has_value();
    }
    if (!mentioned("drop_height")) {
        build_.report.error(*own.map, "the ball has no place; give it 'position' or 'drop_height'");
        return false;
    }
    const Layer& layer = own.mentions("drop_height") ? own : defaults_;
    const std::optional<double> gap = layer.fields.maybe_number("drop_height");
    const Vec2 at = own.fields.vec2("at");
    ball.position = Vec3(at.x(), at.y(), gap.value_or(0) + ball.radius);
    return radius && gap && (own.fields.has("at") || !own.mentions("at"));
}

bool BallBuilder::fits_limits(const Fields& repeat, const Node& node, const Ball& ball) {
    const Node* count = repeat.find("count");
    if (count == nullptr) return false;
    double product = 1;
    std::string longest = ball.name;
    for (const Node& one : count->children) {
        product *= node_number(one);
        longest += fmt::format("_{}", static_cast<long long>(node_number(one)) - 1);
    }
    asked_for_ += product;
    if (asked_for_ > kMostBalls) {
        build_.report.error(*count, fmt::format("this makes {:.0f} balls; a scene may have at most "
                                                "{:.0f}",
                                                asked_for_, kMostBalls));
        return false;
    }
    if (longest.size() > kMaxNameLength) {
        build_.report.error(node,
                            fmt::format("with 'repeat' the name grows to '{}', longer than {} "
                                        "characters",
                                        longest, kMaxNameLength));
        return false;
    }
    return true;
}

std::vector<Ball> BallBuilder::unroll(const Layer& own, const Ball& ball, bool& sound) {
    const Node* node = own.map->find("repeat");
    if (node == nullptr) {
        asked_for_ += 1;
        return {ball};
    }
    const Fields repeat = own.fields.child("repeat");
    if (!node->valid || !own.fields.has("name") ||
        !fits_limits(repeat, *own.fields.find("name"), ball)) {
        sound = false;
        return {ball};
    }
    RepeatGrid grid;
    const Vec3 counts = repeat.vec3("count");
    for (int axis = 0; axis < 3; ++axis)
        grid.count[static_cast<std::size_t>(axis)] = static_cast<int>(counts[axis]);
    const Node* spacing = repeat.find("spacing");
    grid.spacing = spacing->kind == Node::Kind::kList ? repeat.vec3("spacing")
                                                      : Vec3::Constant(node_number(*spacing));
    grid.jitter = repeat.number("jitter");
    grid.seed = static_cast<std::uint64_t>(repeat.number("seed"));
    const Vec3 last = ball.position + grid.spacing.cwiseProduct(counts);
    if (last.cwiseAbs().maxCoeff() > kLargestCoordinate) {
        build_.report.error(*spacing,
                            fmt::format("the last ball would stand further than {} m from "
                                        "the origin",
                                        number_text(kLargestCoordinate)));
        sound = false;
        return {ball};
    }
    return repeat_ball(ball, grid);
}

void BallBuilder::add(const Node& node) {
    if (node.kind != Node::Kind::kMap) return;
    const Layer own = read_layer(build_, Section::kBall, &node);
    Ball ball;
    ball.name = own.fields.maybe_word("name").value_or("");
    ball.mark = node.mark;
    bool sound = place(own, ball);
    ball.mass = settle(own, "mass", &Preset::mass).value_or(own.fields.number("mass"));
    ball.inertia_factor =
        settle(own, "inertia", &Preset::inertia_factor).value_or(ball.inertia_factor);
    ball.velocity = start_vector(own, "velocity");
    ball.spin = start_vector(own, "spin");
    ball.material = material(own);
    ball.flight = flight(own);
    const Preset* preset = own.preset != nullptr ? own.preset : defaults_.preset;
    ball.preset = preset == nullptr ? "" : std::string(preset->name);

    const Node* own_look = own.fields.find("look");
    if (own_look != nullptr && resolve_look(build_, *own_look) < 0) own_look = nullptr;
    for (Ball& one : unroll(own, ball, sound)) {
        one.look = look(own, own_look);
        build_.scene.balls.push_back(std::move(one));
        build_.ball_origins.push_back({&node, sound});
    }
}

}  // namespace

int resolve_ball(Build& build, const Node& reference) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < build.scene.balls.size(); ++i) {
        names.push_back(build.scene.balls[i].name);
        if (names.back() == reference.text) return static_cast<int>(i);
    }
    build.report.error(reference,
                       fmt::format("there is no ball {}{}", quoted_excerpt(reference.text),
                                   suggestion(reference.text, names)));
    return -1;
}

void build_balls(Build& build) {
    BallBuilder builder(build);
    for (const Node& node : build.entries("balls")) builder.add(node);
}

}  // namespace carom
