// A scene as plain values: what the YAML file says, validated, with every default filled in.
// SI units, z up, right-handed. Keys and defaults are described in docs/scene.md.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/diagnostics.h"
#include "core/types.h"
#include "geometry/shape.h"
#include "scene/air.h"
#include "scene/restitution_law.h"

namespace carom {

/// The paper's virtual body: its surface lies `distance_m` below the real one and moves towards the
/// contact at `velocity_m_s` (Khurelbaatar et al. 2012, section 5). A distance of infinity stands
/// for a material that never rebounds (`restitution: 0`); a distance of 0 loses nothing.
struct VirtualBody {
    double distance_m = 0;
    double velocity_m_s = 1;
};

struct Material {
    std::string name;                ///< "" is the default material, always at index 0
    VirtualBody virtual_body;        ///< `restitution: e` is stored as x/v = -2 ln e / K, v = 1
    std::optional<double> friction;  ///< Coulomb's mu against a reference of 1; none if not named
    /// The coefficient over the approach speed; the virtual body then loses nothing.
    std::optional<RestitutionLaw> restitution_law{};
    std::optional<double> rolling{};   ///< deceleration over N/m, against a reference of 1
    std::optional<double> pivoting{};  ///< moment against spin about the normal over N, m
    std::optional<double> tangential_restitution{};  ///< -1 ... 1
    SourceMark mark;
};

/// Overrides the pair rule for two materials (indices into Scene::materials).
struct PairRule {
    std::array<int, 2> between{};
    std::optional<double> restitution;
    std::optional<double> friction;
    SourceMark mark;
    // As in Material.
    std::optional<RestitutionLaw> restitution_law{};
    std::optional<double> rolling{};
    std::optional<double> pivoting{};
    std::optional<double> tangential_restitution{};
};

/// Linear pictures have linear colours; the scene has sRGB ones, each channel 0 ... 1.
struct Color {
    double r = 0.8, g = 0.8, b = 0.8;
};

/// Markings of balls, and patterns of surfaces. docs/scene.md says what each looks like.
enum class LookStyle {
    kPlain,
    kStriped,
    kBasketball,
    kVolleyball,
    kFootball,
    kTennis,
    kTableTennis,
    kChecker,
    kGrid,
    kWood,
    kCourt,
};

struct Look {
    std::string name;  ///< "" for a default
    LookStyle style = LookStyle::kPlain;
    Color color;            ///< the main colour
    Color second_color;     ///< stripes, seams, the checker's other squares, lines
    double tile_m = 0.5;    ///< edge of a square, width of a plank, m
    double reflection = 0;  ///< of planes and boxes' tops: 0 dull ... 1 as a pane of glass
};

/// A static body.
struct Surface {
    std::string name;
    SurfaceShape shape;
    int material = 0;  ///< index into Scene::materials
    int look = 0;      ///< index into Scene::looks
    SourceMark mark;
};

struct Ball {
    std::string name;
    double radius = 0.1;          ///< m
    double mass = 1;              ///< kg
    double inertia_factor = 0.4;  ///< k of I = k m r^2: 2/5 solid, 2/3 thin shell
    int material = 0;
    int look = 0;
    Vec3 position = Vec3::Zero();  ///< of the centre, m
    Vec3 velocity = Vec3::Zero();  ///< m/s
    Vec3 spin = Vec3::Zero();      ///< angular velocity, world axes, rad/s
    Flight flight;                 ///< only read where the scene has air
    std::string preset;            ///< "" or the catalogue's name
    SourceMark mark;
};

enum class Method { kFixed, kExact };
enum class Solver { kWorld, kQuick };

struct Simulation {
    /// s; empty: until everything rests, at most max_duration.
    std::optional<double> duration = 10.0;
    double max_duration = 600;          ///< s
    Vec3 gravity = Vec3(0, 0, -9.81);   ///< m/s^2
    double restitution_constant = 4.0;  ///< K of Eq. 7, 1/s
    Method method = Method::kExact;
    double step = 0.00025;  ///< s, method fixed only
    Solver solver = Solver::kWorld;
    int iterations = 20;  ///< solver quick only
};

/// What a camera that moves along a path shows at one instant of the motion.
struct CameraKey {
    double time = 0;  ///< s of the motion
    Vec3 from = Vec3::Zero();
    Vec3 to = Vec3::UnitY();
    double fov_deg = 40;
};

/// `from`, `to` and `fov_deg` are those of the motion's start; render/view/camera_motion.h moves
/// them.
struct Camera {
    Vec3 from = Vec3(0, -6, 1.5);
    Vec3 to = Vec3(0, 0, 1);
    Vec3 up = Vec3::UnitZ();
    double fov_deg = 40;  ///< vertical
    /// Height of the picture in metres under parallel rays along `to - from`; empty: a pinhole.
    std::optional<double> orthographic_m;
    std::optional<int> follow;    ///< ball (index into Scene::balls) that `to` keeps to
    double smooth_s = 0;          ///< s of the motion over which the followed path is averaged
    double orbit_deg_per_s = 0;   ///< turn of `from` about the upright through `to`
    std::vector<CameraKey> path;  ///< by time, increasing; empty: none
};

/// Frames per second as a fraction, so that 30000/1001 is exact.
struct FrameRate {
    int numerator = 60;
    int denominator = 1;
    double per_second() const { return static_cast<double>(numerator) / denominator; }
};

/// Speed of a film at one instant of the motion.
struct SpeedKey {
    double time = 0;   ///< s of the motion
    double speed = 1;  ///< seconds of motion per second of film
};

struct Film {
    int width_px = 1280;
    int height_px = 720;
    FrameRate fps;
    double start = 0;            ///< s of the motion that frame 0 shows
    double speed = 1;            ///< seconds of motion per second of film; at the end of a ramp
    std::vector<SpeedKey> ramp;  ///< by time, increasing, linear between; empty: `speed` throughout
    std::vector<double> stills;  ///< s of the motion
    /// Part of a frame's film time, in degrees of 360, over which a picture is exposed; 0: none.
    double shutter_deg = 0;
    bool sound = false;  ///< a sound track of the impacts, where the container holds one
};

/// What lies behind the balls: the sky over the surfaces, or nothing. See docs/scene.md.
enum class Background { kSky, kTransparent };

/// How a second run is shown: in the same picture, translucent, or beside the first.
enum class AgainstView { kGhost, kSide };

/// A second run that is filmed with the first: another scene, or this one with values set.
struct Against {
    std::string scene;             ///< path as the file says it; "" for the same scene
    std::vector<std::string> set;  ///< PATH=VALUE
    AgainstView view = AgainstView::kGhost;
};

enum class Corner { kTopLeft, kTopRight, kBottomLeft, kBottomRight };

/// A vertical scale in metres. Its foot stands at (x, y, from); chosen beside the motion if empty.
struct RulerOptions {
    std::optional<Vec2> at;
    double from = 0;           ///< m
    std::optional<double> to;  ///< m; default: the next metre or half metre above the motion
    std::optional<std::array<double, 2>> band;  ///< heights between which it is marked, m
};
struct ClockOptions {
    Corner corner = Corner::kTopLeft;
    int digits = 2;  ///< after the decimal point
};
struct TrailOptions {
    double seconds = std::numeric_limits<double>::infinity();  ///< how far back it reaches
    double width_px = 2.0;                                     ///< at a height of 720 pixels
};
struct LabelOptions {
    double size_px = 15;  ///< of the letters, at a height of 720 pixels
};

struct TitleOptions {
    double size_px = 22;  ///< of the letters, at a height of 720 pixels
};
struct PeakOptions {
    double size_px = 13;  ///< of the letters, at a height of 720 pixels
};
struct VelocityOptions {
    std::optional<double> scale_s;  ///< metres of arrow per m/s; default: chosen for the motion
};
struct PlotOptions {
    std::vector<int> balls;  ///< indices into Scene::balls
    Corner corner = Corner::kTopRight;
    std::array<double, 2> size{0.36, 0.36};  ///< shares of the picture's width and height
};

/// Light plates with dark letters, or dark ones with light letters.
enum class Theme { kLight, kDark };

/// What is written over the picture; empty means not drawn, and costs nothing.
struct Overlay {
    std::optional<RulerOptions> ruler;
    std::optional<ClockOptions> clock;
    std::optional<TrailOptions> trail;
    std::optional<LabelOptions> labels;
    std::optional<TitleOptions> title{};  ///< of Scene::title
    std::string caption{};                ///< "" for none
    std::optional<PeakOptions> peaks{};
    std::optional<VelocityOptions> velocity{};
    std::optional<PlotOptions> plot{};
    Theme theme = Theme::kLight;
};

/// The rule of a drop test: how high the first rebound of a ball must come. Heights are over what
/// it rebounds from, as the ball's peaks are.
struct ReboundTest {
    int ball = 0;  ///< index into Scene::balls
    double low_m = 0, high_m = 0;
    bool to_top = false;  ///< measured to the ball's top; else to its bottom
    std::string rule;     ///< whose rule it is; may be empty
};

struct Scene {
    std::string file;               ///< as the user named it, for messages
    std::uint64_t fingerprint = 0;  ///< of the document with what the command line changed in it
    std::string title;
    Simulation simulation;
    std::optional<Air> air;           ///< empty: a vacuum
    std::vector<Material> materials;  ///< [0] is the default: restitution 1, no friction
    std::vector<PairRule> pairs;
    std::vector<Look> looks;
    std::vector<Surface> surfaces;
    std::vector<Ball> balls;       ///< `repeat` is unrolled, in the scene's order
    std::optional<Camera> camera;  ///< empty: framed around the motion
    Film film;
    Overlay overlay;
    std::optional<ReboundTest> test;
    Background background = Background::kSky;
    std::optional<Against> against;
};

}  // namespace carom
