// A pile poured into a box: the method `exact` against `fixed` with QuickStep, 20 iterations and
// steps of 1e-3 s, over the same seconds of motion: neither has all balls below 1e-3 m/s by then,
// because one that is alone on the floor rolls on. Prints CPU seconds of both and what became of
// the pile. Arguments: --quick (200 balls, 2 s), --balls N, --seconds S, --restitution E,
// --friction MU, --only exact|fixed.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"
#include "sim/simulate.h"

namespace {

using namespace carom;

constexpr double kRadius = 0.05;      // m
constexpr double kSpacing = 0.12;     // m, of the lattice that the balls start on
constexpr double kStill = 1e-3;       // m/s: all speeds below this is rest
constexpr double kSampling = 0.0097;  // s, no multiple of any step

struct Options {
    std::vector<int> balls = {200, 1000};
    double seconds = 6;
    double restitution = 0.5, friction = 0.3;
    std::string only;
};

double cpu_seconds() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void add_box(Scene& scene, const Vec3& center, const Vec3& size) {
    Surface s;
    s.name = fmt::format("box{}", scene.surfaces.size());
    s.shape = BoxShape{center, size, Quat::Identity()};
    scene.surfaces.push_back(s);
}

/// A box that is open above, of inner side `side`, about z >= 0.
void add_container(Scene& scene, double side, double height) {
    const double thick = 0.1, middle = 0.5 * (side + thick);
    add_box(scene, Vec3(0, 0, -0.5 * thick), Vec3(side + 2 * thick, side + 2 * thick, thick));
    for (const double to : {-1.0, 1.0}) {
        add_box(scene, Vec3(to * middle, 0, 0.5 * height), Vec3(thick, side + 2 * thick, height));
        add_box(scene, Vec3(0, to * middle, 0.5 * height), Vec3(side, thick, height));
    }
}

int side_of(int balls) { return std::max(2, static_cast<int>(std::cbrt(0.7 * balls))); }

Scene pouring(int balls, const Options& options) {
    Scene scene;
    scene.materials.resize(1);
    scene.pairs.push_back({{0, 0}, options.restitution, options.friction, {}});
    const int side = side_of(balls);
    const double height = 2.5 * kSpacing * (balls / (side * side) + 1);
    add_container(scene, kSpacing * side, height);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> jitter(-0.005, 0.005);
    for (int i = 0; i < balls; ++i) {
        Ball ball;
        ball.name = fmt::format("ball{}", i);
        ball.radius = kRadius;
        const double x = jitter(random), y = jitter(random), z = jitter(random);
        const Vec3 cell(i % side - 0.5 * (side - 1), i / side % side - 0.5 * (side - 1),
                        i / (side * side) + 0.5);
        ball.position = kSpacing * cell + Vec3(x, y, z + 0.2);
        scene.balls.push_back(ball);
    }
    scene.simulation.duration = options.seconds;
    scene.simulation.iterations = 20;
    scene.simulation.step = 1e-3;
    return scene;
}

struct Pile {
    int outside = 0;
    double deepest = 0;      ///< overlap over the radius
    double energy_rise = 0;  ///< over the running minimum, in units of the start
    double rest_since = 0;   ///< s; after the end if it still moves
    double end_speed = 0;    ///< m/s
    int moving = 0;          ///< balls that are not still at the end
};

/// The deepest overlap of two balls or of a ball and the container, m.
double overlap_of(const std::vector<BallState>& balls, double half) {
    double deepest = 0;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const Vec3& x = balls[i].position;
        deepest = std::max({deepest, kRadius - x.z(), std::abs(x.x()) + kRadius - half,
                            std::abs(x.y()) + kRadius - half});
        for (std::size_t j = 0; j < i; ++j) {
            const double distance2 = (x - balls[j].position).squaredNorm();
            if (distance2 < 4 * kRadius * kRadius)
                deepest = std::max(deepest, 2 * kRadius - std::sqrt(distance2));
        }
    }
    return deepest;
}

Pile examine(const Scene& scene, const Motion& motion) {
    Pile pile;
    const double half = 0.5 * kSpacing * side_of(static_cast<int>(scene.balls.size()));
    double least = INFINITY, start = 0;
    std::vector<BallState> balls(scene.balls.size());
    for (int k = 0; k * kSampling <= motion.duration; ++k) {
        const double t = k * kSampling;
        double energy = 0;
        pile.end_speed = 0;
        pile.outside = pile.moving = 0;
        for (std::size_t i = 0; i < balls.size(); ++i) {
            const Ball& b = scene.balls[i];
            balls[i] = motion.balls[i].at(t);
            const BallState& s = balls[i];
            const double rim = b.radius * s.spin.norm();
            energy += b.mass * (0.5 * s.velocity.squaredNorm() +
                                0.5 * b.inertia_factor * rim * rim + 9.81 * s.position.z());
            pile.end_speed = std::max(pile.end_speed, s.velocity.norm());
            pile.moving += s.velocity.norm() >= kStill ? 1 : 0;
            const bool inside = s.position.z() > 0 && std::abs(s.position.x()) < half &&
                                std::abs(s.position.y()) < half;
            pile.outside += inside ? 0 : 1;
        }
        if (k == 0) start = least = energy;
        pile.energy_rise = std::max(pile.energy_rise, (energy - least) / start);
        least = std::min(least, energy);
        if (pile.end_speed >= kStill) pile.rest_since = t + kSampling;
        pile.deepest = std::max(pile.deepest, overlap_of(balls, half) / kRadius);
    }
    return pile;
}

double measure(Scene scene, Method method) {
    scene.simulation.method = method;
    if (method == Method::kFixed) scene.simulation.solver = Solver::kQuick;
    const double start = cpu_seconds();
    const SimulationResult result = simulate(scene);
    const double seconds = cpu_seconds() - start;
    const Pile pile = examine(scene, result.motion);
    std::size_t pieces = 0;
    for (const Trajectory& t : result.motion.balls) pieces += t.pieces().size();
    const std::string rest = pile.rest_since <= result.motion.duration
                                 ? fmt::format("all below 1e-3 m/s from {:.2f} s", pile.rest_since)
                                 : fmt::format("{} above 1e-3 m/s at the end, up to {:.1e}",
                                               pile.moving, pile.end_speed);
    fmt::print(
        "{:5} balls {:5} {:8.2f} s CPU | {} | outside {} | overlap/R {:.1e} | energy rise {:.1e} | "
        "{} impacts, {} steps, {} pieces | hash {:016x}\n",
        scene.balls.size(), method == Method::kExact ? "exact" : "fixed", seconds, rest,
        pile.outside, pile.deepest, pile.energy_rise, result.report.impacts, result.report.steps,
        pieces, result.motion.hash());
    std::fflush(stdout);
    return seconds;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    for (int i = 1; i < argc; ++i) {
        const std::string_view name = argv[i];
        if (name == "--quick") {
            options.balls = {200};
            options.seconds = 2;
            continue;
        }
        if (i + 1 == argc) {
            fmt::print(stderr, "pile: {} is unknown or lacks its value\n", name);
            return 2;
        }
        const char* value = argv[++i];
        if (name == "--balls") {
            options.balls = {std::atoi(value)};
        } else if (name == "--seconds") {
            options.seconds = std::atof(value);
        } else if (name == "--restitution") {
            options.restitution = std::atof(value);
        } else if (name == "--friction") {
            options.friction = std::atof(value);
        } else if (name == "--only") {
            options.only = value;
        } else {
            fmt::print(stderr, "pile: unknown option {}\n", name);
            return 2;
        }
    }
    for (const int balls : options.balls) {
        const Scene scene = pouring(balls, options);
        const double fixed = options.only == "exact" ? 0 : measure(scene, Method::kFixed);
        const double exact = options.only == "fixed" ? 0 : measure(scene, Method::kExact);
        if (options.only.empty())
            fmt::print("{:5} balls: exact costs {:.2f} of fixed\n", balls, exact / fixed);
    }
    return 0;
}
