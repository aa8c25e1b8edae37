#include "trajectory_measures.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/nearest.h"

namespace carom::bench {

namespace {

/// Calls use(piece, end) for the ball's pieces up to the duration.
template <class Use>
void for_each_piece(const Motion& motion, std::size_t ball, const Use& use) {
    const std::vector<Piece>& pieces = motion.balls[ball].pieces();
    for (std::size_t i = 0; i < pieces.size() && pieces[i].start <= motion.duration; ++i) {
        const double end = i + 1 < pieces.size() ? pieces[i + 1].start : motion.duration;
        use(pieces[i], std::min(end, motion.duration));
    }
}

/// Where the speed along `normal` crosses 0 inside a piece, or nothing.
std::vector<double> zero_of_speed(const Piece& piece, double end, const Vec3& normal) {
    double a = piece.start, b = end;
    double va = piece.velocity_at(a).dot(normal), vb = piece.velocity_at(b).dot(normal);
    if (!(va * vb < 0)) return {};
    for (int i = 0; i < 80 && piece.curve; ++i) {
        const double middle = 0.5 * (a + b), v = piece.velocity_at(middle).dot(normal);
        (v * va > 0 ? a : b) = middle;
        (v * va > 0 ? va : vb) = v;
    }
    return {a + (b - a) * va / (va - vb)};  // exact where the speed is linear
}

}  // namespace

std::vector<Turning> turning_points(const Motion& motion, std::size_t ball, const Vec3& normal) {
    std::vector<Turning> found;
    double before = 0;
    for_each_piece(motion, ball, [&](const Piece& piece, double end) {
        const double after = piece.velocity_at(piece.start).dot(normal);
        if (before * after < 0)
            found.push_back({piece.start, piece.position.dot(normal), before < 0});
        for (const double t : zero_of_speed(piece, end, normal))
            found.push_back({t, piece.position_at(t).dot(normal), after < 0});
        before = piece.velocity_at(end).dot(normal);
    });
    return found;
}

std::vector<double> bounce_times(const Motion& motion, std::size_t ball, const Vec3& normal) {
    std::vector<double> times;
    for (const Turning& t : turning_points(motion, ball, normal))
        if (t.bottom) times.push_back(t.time);
    return times;
}

std::vector<double> top_heights(const Motion& motion, std::size_t ball, const Vec3& normal) {
    std::vector<double> heights;
    bool bounced = false;
    for (const Turning& t : turning_points(motion, ball, normal)) {
        if (!t.bottom && bounced) heights.push_back(t.height);
        bounced |= t.bottom;
    }
    return heights;
}

double at_or_nan(const std::vector<double>& values, std::size_t i) {
    return i < values.size() ? values[i] : std::numeric_limits<double>::quiet_NaN();
}

double last_time_above(const Motion& motion, std::size_t ball, const Vec3& normal, double height) {
    double last = 0;
    for_each_piece(motion, ball, [&](const Piece& piece, double end) {
        const auto above = [&](double t) { return piece.position_at(t).dot(normal) > height; };
        if (above(end)) {
            last = end;
            return;
        }
        // The latest of the piece's ends and its turning point that is above; down from there.
        double high = piece.start;
        for (const double t : zero_of_speed(piece, end, normal))
            if (above(t)) high = t;
        if (!above(high)) return;
        double low = end;
        for (int i = 0; i < 80; ++i) {
            const double middle = 0.5 * (high + low);
            (above(middle) ? high : low) = middle;
        }
        last = low;
    });
    return last;
}

double path_length(const Motion& motion, std::size_t ball, const Vec3& normal) {
    double sum = 0;
    for_each_piece(motion, ball, [&](const Piece& piece, double end) {
        double at = piece.start;
        std::vector<double> stops = zero_of_speed(piece, end, normal);
        stops.push_back(end);
        for (const double next : stops) {
            sum += std::abs((piece.position_at(next) - piece.position_at(at)).dot(normal));
            at = next;
        }
    });
    return sum;
}

int velocity_jumps(const Motion& motion, std::size_t ball, double speed) {
    int jumps = -1;  // the first piece begins from nothing
    Vec3 before = Vec3::Constant(std::numeric_limits<double>::infinity());
    for_each_piece(motion, ball, [&](const Piece& piece, double end) {
        if (!((piece.velocity_at(piece.start) - before).norm() <= speed)) ++jumps;
        before = piece.velocity_at(end);
    });
    return jumps;
}

double last_flight_start(const Scene& scene, const Motion& motion, std::size_t ball) {
    const Vec3& g = scene.simulation.gravity;
    double start = std::numeric_limits<double>::quiet_NaN();
    bool flying = false;
    for_each_piece(motion, ball, [&](const Piece& piece, double) {
        const bool free = !piece.curve && (piece.acceleration - g).norm() <= 1e-9 * g.norm();
        if (free && !flying) start = piece.start;
        flying = free;
    });
    return flying ? start : std::numeric_limits<double>::quiet_NaN();
}

double kinetic_energy(const Scene& scene, const Motion& motion, double t) {
    double sum = 0;
    for (std::size_t i = 0; i < scene.balls.size(); ++i) {
        const Ball& b = scene.balls[i];
        const BallState s = motion.balls[i].at(t);
        const double inertia = b.inertia_factor * b.mass * b.radius * b.radius;
        sum += 0.5 * (b.mass * s.velocity.squaredNorm() + inertia * s.spin.squaredNorm());
    }
    return sum;
}

double total_energy(const Scene& scene, const Motion& motion, double t) {
    double sum = kinetic_energy(scene, motion, t);
    for (std::size_t i = 0; i < scene.balls.size(); ++i)
        sum -= scene.balls[i].mass * scene.simulation.gravity.dot(motion.balls[i].at(t).position);
    return sum;
}

Vec3 momentum(const Scene& scene, const Motion& motion, double t) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < scene.balls.size(); ++i)
        sum += scene.balls[i].mass * motion.balls[i].at(t).velocity;
    return sum;
}

double deepest_overlap(const Scene& scene, const Motion& motion, double t) {
    std::vector<Vec3> at;
    for (const Trajectory& trajectory : motion.balls) at.push_back(trajectory.at(t).position);
    double deepest = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
        const double r = scene.balls[i].radius;
        for (const Surface& surface : scene.surfaces)
            deepest = std::max(deepest, r - signed_distance(surface.shape, at[i]));
        for (std::size_t j = 0; j < i; ++j) {
            const double sum = r + scene.balls[j].radius;
            if ((at[i] - at[j]).squaredNorm() >= sum * sum) continue;
            deepest = std::max(deepest, sum - (at[i] - at[j]).norm());
        }
    }
    return deepest;
}

std::string diagnosis(const Scene& scene, const Motion& motion) {
    constexpr int kSamples = 200;
    constexpr double kGain = 1e-3;  // of the largest kinetic energy and the weight times the radius
    constexpr double kDepth = 0.05;  // of the smallest radius
    double radius = std::numeric_limits<double>::infinity(), weight = 0;
    for (const Ball& ball : scene.balls) {
        radius = std::min(radius, ball.radius);
        weight += ball.mass * scene.simulation.gravity.norm() * ball.radius;
    }

    double least = std::numeric_limits<double>::infinity(), gain = 0, kinetic = 0, deepest = 0;
    for (int i = 0; i <= kSamples; ++i) {
        const double t = motion.duration * i / kSamples;
        const double energy = total_energy(scene, motion, t);
        least = std::min(least, energy);
        gain = std::max(gain, energy - least);
        kinetic = std::max(kinetic, kinetic_energy(scene, motion, t));
        if (scene.balls.size() <= 200)
            deepest = std::max(deepest, deepest_overlap(scene, motion, t));
    }
    std::string text;
    if (deepest > radius)
        text += "bodies pass through one another; ";
    else if (deepest > kDepth * radius)
        text += fmt::format("overlaps by {:.2g} of the radius; ", deepest / radius);
    if (gain > kGain * (kinetic + weight)) text += fmt::format("gains energy ({:.2g} J); ", gain);
    return text.empty() ? text : text.substr(0, text.size() - 2);
}

}  // namespace carom::bench
