#include "piece_sampling.h"

#include <algorithm>
#include <cmath>

namespace carom::bench {

namespace {

/// A polynomial piece as plain numbers, and what turns its state into energy.
struct Terms {
    double position[3], velocity[3], acceleration[3], spin[3], spin_rate[3];
    double half_mass, half_inertia, weight[3];  ///< kg, kg m^2, N (energy is minus weight . p)
    double start, sampling;                     ///< s
};

/// energy[k - first] += the ball's energy at k sampling.
__attribute__((target_clones("default", "avx2", "avx512f"))) void add_energies(const Terms& terms,
                                                                               int first, int last,
                                                                               double* energy) {
    const Terms t = terms;
    for (int k = first; k < last; ++k) {
        const double s = k * t.sampling - t.start;
        double moving = 0, turning = 0, potential = 0;
        for (int c = 0; c < 3; ++c) {
            const double v = t.velocity[c] + s * t.acceleration[c];
            const double w = t.spin[c] + s * t.spin_rate[c];
            const double p = t.position[c] + s * (t.velocity[c] + 0.5 * s * t.acceleration[c]);
            moving += v * v;
            turning += w * w;
            potential -= t.weight[c] * p;
        }
        energy[k] += t.half_mass * moving + t.half_inertia * turning + potential;
    }
}

void copy(const Vec3& from, double* to) {
    for (int c = 0; c < 3; ++c) to[c] = from[c];
}

Terms terms_of(const Ball& ball, const Vec3& gravity, const Piece& piece, double sampling) {
    Terms t{};
    copy(piece.position, t.position);
    copy(piece.velocity, t.velocity);
    copy(piece.acceleration, t.acceleration);
    copy(piece.spin, t.spin);
    copy(piece.spin_rate, t.spin_rate);
    copy(ball.mass * gravity, t.weight);
    t.half_mass = 0.5 * ball.mass;
    t.half_inertia = 0.5 * ball.inertia_factor * ball.mass * ball.radius * ball.radius;
    t.start = piece.start;
    t.sampling = sampling;
    return t;
}

double energy_at(const Ball& ball, const Vec3& gravity, const Piece& piece, double t) {
    const BallState s = piece.at(t);
    const double inertia = ball.inertia_factor * ball.mass * ball.radius * ball.radius;
    return 0.5 * (ball.mass * s.velocity.squaredNorm() + inertia * s.spin.squaredNorm()) -
           ball.mass * gravity.dot(s.position);
}

}  // namespace

std::vector<double> sample_energies(const Scene& scene, const Motion& motion, double sampling,
                                    std::size_t samples) {
    std::vector<double> energy(samples, 0.0);
    const int count = static_cast<int>(samples);
    const Vec3& g = scene.simulation.gravity;
    for (std::size_t i = 0; i < scene.balls.size(); ++i) {
        const std::vector<Piece>& pieces = motion.balls[i].pieces();
        int first = 0;
        for (std::size_t p = 0; p < pieces.size() && first < count; ++p) {
            int last = count;
            if (p + 1 < pieces.size()) {  // samples before the next piece's start
                const double end = std::ceil(pieces[p + 1].start / sampling);
                last = end < count ? static_cast<int>(end) : count;
                while (last > first && (last - 1) * sampling >= pieces[p + 1].start) --last;
                while (last < count && last * sampling < pieces[p + 1].start) ++last;
            }
            if (last <= first) continue;
            if (!pieces[p].curve)
                add_energies(terms_of(scene.balls[i], g, pieces[p], sampling), first, last,
                             energy.data());
            for (int k = first; k < last && pieces[p].curve; ++k)
                energy[static_cast<std::size_t>(k)] +=
                    energy_at(scene.balls[i], g, pieces[p], k * sampling);
            first = last;
        }
    }
    return energy;
}

}  // namespace carom::bench
