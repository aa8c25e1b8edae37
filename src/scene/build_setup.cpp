// Simulation, film and camera.
#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "scene/build.h"
#include "scene/film_clock.h"
#include "scene/frame_rate.h"
#include "scene/scalar.h"

namespace carom {

namespace {

/// Empty for `duration: rest`.
std::optional<double> read_duration(const Fields& fields) {
    const Node* node = fields.find("duration");
    if (node != nullptr && node->text == "rest") return std::nullopt;
    return fields.number("duration");
}

/// Keys that the method or the solver at hand does not read, where they say something of their own.
void warn_of_unread_keys(Build& build, const Fields& fields) {
    const Simulation& simulation = build.scene.simulation;
    const auto warn = [&](const char* key, const std::string& reader, const std::string& chosen) {
        build.report.warning(
            *fields.find(key),
            fmt::format("'{}' is read by {} only, and this scene's is {}", key, reader, chosen));
    };
    const Simulation defaults;
    if (simulation.method == Method::kExact) {
        const std::string reader = "the method 'fixed'";
        if (simulation.step != defaults.step) warn("step", reader, "'exact'");
        if (simulation.solver != defaults.solver) warn("solver", reader, "'exact'");
        if (simulation.iterations != defaults.iterations) warn("iterations", reader, "'exact'");
    } else if (simulation.solver != Solver::kQuick &&
               simulation.iterations != defaults.iterations) {
        warn("iterations", "the solver 'quick'", "'world'");
    }
}

void build_simulation(Build& build) {
    const Fields fields = build.top().child("simulation");
    Simulation& simulation = build.scene.simulation;
    simulation.duration = read_duration(fields);
    simulation.max_duration = fields.number("max_duration");
    simulation.gravity = fields.vec3("gravity");
    simulation.restitution_constant = fields.number("restitution_constant");
    simulation.method = fields.word("method") == "fixed" ? Method::kFixed : Method::kExact;
    simulation.step = fields.number("step");
    simulation.solver = fields.word("solver") == "quick" ? Solver::kQuick : Solver::kWorld;
    simulation.iterations = fields.integer("iterations");
    warn_of_unread_keys(build, fields);
}

FrameRate read_frame_rate(const Fields& fields) {
    const Node* node = fields.find("fps");
    const std::size_t slash = node == nullptr ? std::string::npos : node->text.find('/');
    if (slash == std::string::npos) return frame_rate(fields.number("fps"));
    const int numerator = std::stoi(node->text.substr(0, slash));
    const int denominator = std::stoi(node->text.substr(slash + 1));
    const int common = std::gcd(numerator, denominator);
    return {numerator / common, denominator / common};
}

/// Where the motion ends at the latest, s; none if the file is wrong about it.
std::optional<double> last_instant(const Build& build) {
    const Node* simulation = build.root.find("simulation");
    if (simulation != nullptr && !simulation->valid) return std::nullopt;
    return build.scene.simulation.duration.value_or(build.scene.simulation.max_duration);
}

void check_film_times(Build& build, const Fields& fields) {
    const std::optional<double> end = last_instant(build);
    if (!end) return;
    const Node* start = fields.find("start");
    if (start != nullptr && node_number(*start) >= *end)
        build.report.error(*start,
                           fmt::format("the film starts at {} s, but the motion lasts {} s: "
                                       "there would be no frames",
                                       start->text, number_text(*end)));
    constexpr double kMostFrames = 1e9;  // frame numbers are ints
    const Film& film = build.scene.film;
    const double frames = film_time(film, *end) * film.fps.per_second();
    const Node* film_node = build.root.find("film");
    if (frames > kMostFrames && film_node != nullptr && film_node->valid)
        build.report.error(*film_node,
                           fmt::format("the film would have {:.3g} frames; at most {:.0f} "
                                       "are possible",
                                       frames, kMostFrames));
    const Node* stills = fields.find("stills");
    if (stills == nullptr) return;
    for (const Node& still : stills->children)
        if (node_number(still) > *end)
            build.report.error(still, fmt::format("the still at {} s is outside the motion, which "
                                                  "lasts {} s",
                                                  still.text, number_text(*end)));
}

/// One speed, or a ramp.
void read_speed(Build& build, const Fields& fields) {
    Film& film = build.scene.film;
    const Node* node = fields.find("speed");
    if (node == nullptr || node->kind != Node::Kind::kList) {
        film.speed = fields.number("speed");
        return;
    }
    if (node->children.empty()) build.report.error(*node, "the list of speeds has no entries");
    for (const Node& entry : node->children) {
        const Fields key = build.fields(Section::kSpeedKey, &entry);
        if (!key.has("time") || !key.has("speed")) continue;
        const SpeedKey made{key.number("time"), key.number("speed")};
        if (!film.ramp.empty() && made.time <= film.ramp.back().time) {
            build.report.error(*key.find("time"), "the times of the film's speeds must increase");
            continue;
        }
        film.ramp.push_back(made);
        film.speed = made.speed;
    }
}

void build_film(Build& build) {
    constexpr double kMostPixels = 100e6;
    const Fields fields = build.top().child("film");
    Film& film = build.scene.film;
    const Vec2 size = fields.vec2("size");
    film.width_px = static_cast<int>(size.x());
    film.height_px = static_cast<int>(size.y());
    if (size.prod() > kMostPixels)
        build.report.error(*fields.find("size"),
                           fmt::format("a frame of {} x {} has {:.0f} million pixels; at most 100 "
                                       "million are possible",
                                       film.width_px, film.height_px, size.prod() / 1e6));
    film.fps = read_frame_rate(fields);
    film.start = fields.number("start");
    film.shutter_deg = fields.number("shutter_deg");
    const Node* sound = fields.find("sound");
    film.sound = sound != nullptr && sound->text == "true";
    read_speed(build, fields);
    if (const Node* stills = fields.find("stills"))
        for (const Node& still : stills->children) film.stills.push_back(node_number(still));
    check_film_times(build, fields);
}

}  // namespace

void build_setup(Build& build) {
    build.scene.title = build.top().maybe_word("title").value_or("");
    const bool transparent = build.top().word("background") == "transparent";
    build.scene.background = transparent ? Background::kTransparent : Background::kSky;
    build_simulation(build);
    build_film(build);
}

}  // namespace carom
