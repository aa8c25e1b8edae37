#include "motion_checks.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "geometry/nearest.h"

namespace carom::bench {

namespace {

constexpr std::size_t kMostTimes = 20'000;  // of pieces' starts, so that a check stays cheap

/// States of all balls at t, before or after what happens at t.
std::vector<BallState> states(const Motion& motion, double t, bool before) {
    std::vector<BallState> all;
    for (const Trajectory& ball : motion.balls) {
        const std::size_t i = ball.piece_index(before ? std::nextafter(t, -1) : t);
        all.push_back(ball.pieces()[i].at(t));
    }
    return all;
}

struct Energies {
    double total = 0;    ///< J, potential energy 0 at the start
    double in_play = 0;  ///< J
};

Energies energies(const Scene& scene, const std::vector<BallState>& states) {
    Energies e;
    const Vec3& g = scene.simulation.gravity;
    for (std::size_t i = 0; i < states.size(); ++i) {
        const Ball& b = scene.balls[i];
        const double kinetic =
            0.5 * b.mass *
            (states[i].velocity.squaredNorm() +
             b.inertia_factor * b.radius * b.radius * states[i].spin.squaredNorm());
        const bool carried = scene.air && scene.air->buoyancy;
        const double weight = carried ? 1 - buoyant_part(*scene.air, b.radius, b.mass) : 1;
        const double fallen = weight * b.mass * g.dot(states[i].position - b.position);
        e.total += kinetic - fallen;
        e.in_play += kinetic + std::max(std::abs(fallen), b.mass * g.norm() * b.radius);
    }
    return e;
}

}  // namespace

std::vector<double> check_times(const Motion& motion) {
    const int samples = std::max(10, static_cast<int>(1000 * motion.duration));
    std::vector<double> times, starts;
    for (int i = 0; i <= samples; ++i) times.push_back(motion.duration * i / samples);
    for (const Trajectory& ball : motion.balls)
        for (const Piece& piece : ball.pieces()) starts.push_back(piece.start);
    std::sort(starts.begin(), starts.end());
    const std::size_t stride = starts.size() / kMostTimes + 1;
    for (std::size_t i = 0; i < starts.size(); i += stride)
        if (starts[i] <= motion.duration) times.push_back(starts[i]);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

Worst energy_rise(const Scene& scene, const Motion& motion, const std::vector<double>& times) {
    Worst worst;
    double least = INFINITY, in_play = 0;
    for (const double t : times)
        for (const bool before : {true, false}) {
            const Energies e = energies(scene, states(motion, t, before));
            in_play = std::max(in_play, e.in_play);
            if (in_play > 0 && least < INFINITY) worst.take((e.total - least) / in_play, t);
            least = std::min(least, e.total);
        }
    return worst;
}

Worst deepest(const Scene& scene, const Motion& motion, const std::vector<double>& times) {
    Worst worst;
    for (const double t : times) {
        const std::vector<BallState> all = states(motion, t, false);
        for (std::size_t i = 0; i < all.size(); ++i) {
            const Vec3& p = all[i].position;
            const double r = scene.balls[i].radius;
            for (const Surface& s : scene.surfaces) worst.take(r - signed_distance(s.shape, p), t);
            for (std::size_t j = 0; j < i; ++j)
                worst.take(r + scene.balls[j].radius - (p - all[j].position).norm(), t);
        }
    }
    return worst;
}

Worst momentum_error(const Scene& scene, const Motion& motion, const std::vector<double>& times) {
    Worst worst;
    Vec3 start = Vec3::Zero();
    double mass = 0, in_play = 0;
    for (const Ball& b : scene.balls) {
        start += b.mass * b.velocity;
        mass += b.mass;
    }
    for (const double t : times) {
        Vec3 now = Vec3::Zero();
        double sum = 0;
        const std::vector<BallState> all = states(motion, t, false);
        for (std::size_t i = 0; i < all.size(); ++i) {
            now += scene.balls[i].mass * all[i].velocity;
            sum += scene.balls[i].mass * all[i].velocity.norm();
        }
        in_play = std::max(in_play, sum);
        if (in_play > 0)
            worst.take((now - start - mass * t * scene.simulation.gravity).norm() / in_play, t);
    }
    return worst;
}

std::string what_happens_at(const Motion& motion, double t) {
    constexpr double kNear = 1e-9;  // s: rows of the same instant, not of the next bounce
    std::string text;
    int rows = 0;
    for (const Event& e : motion.events) {
        if (std::abs(e.time - t) > kNear || ++rows > 6) continue;
        const auto& names = e.other.is_surface ? motion.surface_names : motion.ball_names;
        text += fmt::format("{} {}-{}, ", event_kind_name(e.kind),
                            motion.ball_names[static_cast<std::size_t>(e.ball)],
                            names[static_cast<std::size_t>(e.other.index)]);
    }
    if (rows == 0) text += "no row, ";
    if (rows > 6) text += fmt::format("{} rows in all, ", rows);
    for (std::size_t i = 0; i < motion.balls.size(); ++i) {
        const Trajectory& ball = motion.balls[i];
        const Piece& piece = ball.pieces()[ball.piece_index(std::nextafter(t, -1))];
        text +=
            fmt::format("{} {} ", motion.ball_names[i],
                        piece.curve                                                ? "integrated"
                        : piece.acceleration.isZero(0) && piece.velocity.isZero(0) ? "rests"
                                                                                   : "polynomial");
    }
    return text;
}

}  // namespace carom::bench
