#include "sim/integrate/flight_piece.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/failure.h"

namespace carom {

namespace {

constexpr std::size_t kNodes = 7;
using Weights = std::array<std::array<double, kNodes>, kNodes>;

/// What is left of the equation moves the ball by less than this part of its way, and changes its
/// speed by less than this part of it.
constexpr double kPlaceError = 3e-14, kSpeedError = 1e-13;

/// Picard's iteration has ended when accelerations change by less than this part.
constexpr double kSettled = 4e-16, kPieceRounding = 1e-14;
constexpr int kMostRounds = 24;

constexpr int kMostTries = 60;

/// s: a bend of the force that comes sooner is none, at some 1e-8 m/s.
constexpr double kSoon = 1e-9;

/// A spin that decays is followed for this part of its time constant: its series ends there.
constexpr double kPartOfDecay = 0.05;

/// Between the nodes, where what is left of the equation is largest.
constexpr std::array<double, 3> kBetween = {0.04, 0.5 - 0.12, 1 - 0.04};

struct Lobatto {
    std::array<double, kNodes> at;  ///< in 0 ... 1
    Weights powers;                 ///< values at the nodes -> coefficients of powers
    Weights integral;               ///< values at the nodes -> integral from 0 to each node
    /// The same at the places between: value and integral.
    std::array<std::array<double, kNodes>, kBetween.size()> between, integral_between;

    Lobatto() {
        const long double inner = std::sqrt(5.0L / 11 - 2.0L / 11 * std::sqrt(5.0L / 3));
        const long double outer = std::sqrt(5.0L / 11 + 2.0L / 11 * std::sqrt(5.0L / 3));
        const std::array<long double, kNodes> x = {-1, -outer, -inner, 0, inner, outer, 1};
        Matrix rows;
        for (std::size_t i = 0; i < kNodes; ++i) {
            at[i] = static_cast<double>((x[i] + 1) / 2);
            rows.row(static_cast<int>(i)) = powers_of((x[i] + 1) / 2);
        }
        const Matrix inverse = rows.inverse();
        for (std::size_t i = 0; i < kNodes; ++i) {
            for (std::size_t j = 0; j < kNodes; ++j)
                powers[i][j] =
                    static_cast<double>(inverse(static_cast<int>(i), static_cast<int>(j)));
            store(integrals_to((x[i] + 1) / 2) * inverse, integral[i]);
        }
        for (std::size_t i = 0; i < kBetween.size(); ++i) {
            store(powers_of(kBetween[i]) * inverse, between[i]);
            store(integrals_to(kBetween[i]) * inverse, integral_between[i]);
        }
    }

  private:
    using Matrix = Eigen::Matrix<long double, kNodes, kNodes>;
    using Row = Eigen::Matrix<long double, 1, kNodes>;

    static Row powers_of(long double u) {
        Row row;
        for (std::size_t j = 0; j < kNodes; ++j)
            row[static_cast<int>(j)] = std::pow(u, static_cast<long double>(j));
        return row;
    }
    static Row integrals_to(long double u) {
        Row row;
        for (std::size_t j = 0; j < kNodes; ++j)
            row[static_cast<int>(j)] =
                std::pow(u, static_cast<long double>(j + 1)) / static_cast<long double>(j + 1);
        return row;
    }
    static void store(const Row& row, std::array<double, kNodes>& weights) {
        for (std::size_t j = 0; j < kNodes; ++j)
            weights[j] = static_cast<double>(row[static_cast<int>(j)]);
    }
};

const Lobatto& lobatto() {
    static const Lobatto kLobatto;
    return kLobatto;
}

using Vectors = std::array<Vec3, kNodes>;

Vec3 sum_of(const Vectors& values, const std::array<double, kNodes>& weights) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t j = 0; j < kNodes; ++j) sum += weights[j] * values[j];
    return sum;
}

/// One try with a length.
class Collocation {
  public:
    Collocation(const AirForce& air, const FlightStart& start, double seconds)
        : air_(air), start_(start), h_(seconds) {}

    /// Whether the iteration comes to an end.
    bool solve(const Vec3& first) {
        const Lobatto& nodes = lobatto();
        Vectors& a = accelerations_;
        a.fill(first);
        double before = std::numeric_limits<double>::infinity();
        for (int round = 0; round < kMostRounds; ++round) {
            double change = 0, size = 0;
            for (std::size_t i = 1; i < kNodes; ++i) {
                const Vec3 v = start_.velocity + h_ * sum_of(a, nodes.integral[i]);
                const Vec3 next = acceleration(v, nodes.at[i]);
                change = std::max(change, (next - a[i]).squaredNorm());
                size = std::max(size, next.squaredNorm());
                a[i] = next;
            }
            if (!std::isfinite(size)) return false;
            // The next round would change as much less as this one did than the one before.
            if (change * change <= kSettled * kSettled * size * std::min(before, size)) return true;
            // Changes that do not fall any more are rounding where they are small.
            if (round > 3 && change > before)
                return change <= kPieceRounding * kPieceRounding * size;
            before = change;
        }
        return false;
    }

    /// What is left of the equation, as a multiple of what is allowed.
    double error() const {
        const Lobatto& nodes = lobatto();
        double worst = 0;
        for (std::size_t i = 0; i < kBetween.size(); ++i) {
            const Vec3 v = start_.velocity + h_ * sum_of(accelerations_, nodes.integral_between[i]);
            const Vec3 left =
                acceleration(v, kBetween[i]) - sum_of(accelerations_, nodes.between[i]);
            worst = std::max(worst, left.squaredNorm());
        }
        worst = std::sqrt(worst);
        const double speed = (start_.velocity + h_ * accelerations_.front()).norm();
        // It changes its sign at every node: over a fifth of the piece at most.
        return std::max(0.02 * h_ * h_ * worst / (kPlaceError * (start_.way + h_ * speed)),
                        0.1 * h_ * worst / (kSpeedError * (start_.speed + speed)));
    }

    Curve curve() const {
        Curve curve;
        curve.seconds = h_;
        for (std::size_t i = 0; i < curve.position.size(); ++i) {
            const Vec3 power = sum_of(accelerations_, lobatto().powers[i + 1]);
            curve.position[i] = (h_ * h_ / static_cast<double>((i + 2) * (i + 3))) * power;
        }
        // The turn is w (t - r t^2/2! + r^2 t^3/3! - ...).
        double term = h_;
        for (std::size_t n = 2; n < curve.turn.size() + 3; ++n) {
            term *= -air_.spin_decay() * h_ / static_cast<double>(n);
            if (n >= 3) curve.turn[n - 3] = term * start_.spin;
        }
        return curve;
    }

  private:
    Vec3 acceleration(const Vec3& v, double u) const {
        const double left = air_.spin_decay() > 0 ? std::exp(-air_.spin_decay() * h_ * u) : 1;
        return start_.pull + air_.acceleration(v, left * start_.spin);
    }
    const AirForce& air_;
    const FlightStart& start_;
    double h_;
    Vectors accelerations_;  ///< m/s^2, at the nodes
};

double to_a_double(double now, double h) { return std::max((now + h) - now, 0.0); }

}  // namespace

FlightPiece flight_piece(const AirForce& air, const FlightStart& start, double now, double guess,
                         double longest) {
    FlightPiece piece;
    piece.acceleration = start.pull + air.acceleration(start.velocity, start.spin);
    piece.spin_rate = -air.spin_decay() * start.spin;
    const double still = air.until_still(start.velocity, start.spin, start.pull);
    double most = still > kSoon ? std::min(longest, still) : longest;
    if (air.spin_decay() > 0) most = std::min(most, kPartOfDecay / air.spin_decay());
    double h = to_a_double(now, std::min(guess, most));
    for (int tries = 0; tries < kMostTries && h > 0; ++tries) {
        Collocation at(air, start, h);
        if (!at.solve(piece.acceleration)) {
            h = to_a_double(now, 0.5 * h);
            continue;
        }
        const double error = at.error();
        const double factor = 0.9 * std::pow(std::max(error, 1e-8), -1.0 / 9);
        if (error <= 1) {
            piece.seconds = h;
            piece.curve = at.curve();
            // What something else has cut short says nothing of the next one.
            piece.next_seconds = std::max(h * std::clamp(factor, 0.5, 4.0), h >= most ? guess : 0);
            return piece;
        }
        h = to_a_double(now, h * std::clamp(factor, 0.1, 0.9));
    }
    throw Failure(FailureKind::kRun, "a flight through air cannot be integrated");
}

}  // namespace carom
