#include "export/key_frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace carom {

namespace {

constexpr std::array<double, 3> kLookedAt = {0.25, 0.5, 0.75};  ///< parts of a span
constexpr int kDeepest = 24;                                    ///< halvings of a piece

float at_or_after(double t) {
    const auto f = static_cast<float>(t);
    return static_cast<double>(f) < t ? std::nextafter(f, std::numeric_limits<float>::infinity())
                                      : f;
}

/// Seconds to the next float.
double float_step(double t) {
    const auto f = static_cast<float>(t);
    return double{std::nextafter(f, std::numeric_limits<float>::infinity())} - double{f};
}

/// Hermite's cubic at the part u of a span of so many seconds.
template <class Vector>
Vector hermite(const Vector& p, const Vector& v, const Vector& q, const Vector& w, double seconds,
               double u) {
    const double u2 = u * u, u3 = u2 * u;
    return (2 * u3 - 3 * u2 + 1) * p + (seconds * (u3 - 2 * u2 + u)) * v + (3 * u2 - 2 * u3) * q +
           (seconds * (u3 - u2)) * w;
}

PlaceKey place_key(const Piece& piece, double t, const Vec3& origin) {
    return {static_cast<float>(t), piece.position_at(t) - origin, piece.velocity_at(t)};
}

/// q' = w q / 2 with the spin w in world axes.
TurnKey turn_key(const Piece& piece, double t) {
    const BallState state = piece.at(t);
    const Quat spin(0, state.spin.x(), state.spin.y(), state.spin.z());
    return {static_cast<float>(t), state.orientation.coeffs(),
            0.5 * (spin * state.orientation).coeffs()};
}

/// rad between two orientations.
double angle_between(const Eigen::Vector4d& a, const Eigen::Vector4d& b) {
    const Eigen::Vector4d nearer = a.dot(b) < 0 ? Eigen::Vector4d(-b) : b;
    return 4 * std::asin(std::min(1.0, 0.5 * (a - nearer).norm()));
}

/// rad between two keys: just below half a turn, which has two shortest ways.
constexpr double kMostTurn = 0.95 * std::numbers::pi;

bool has_constant_spin(const Piece& piece) { return !piece.curve && piece.spin_rate.isZero(0); }

/// How positions are keyed.
struct PlaceTrack {
    Vec3 origin;
    double tolerance;

    PlaceKey key(const Piece& piece, double t) const { return place_key(piece, t, origin); }
    /// Whether a key between two pieces serves both, though its time is rounded.
    bool goes_on(const Piece& before, const Piece& after) const {
        const double t = after.start;
        const Vec3 jump = after.velocity_at(t) - before.velocity_at(t);
        return (after.position_at(t) - before.position_at(t)).norm() +
                   jump.norm() * float_step(t) <=
               0.5 * tolerance;
    }
    bool is_exact_in(const Piece& piece, double, double) const { return !piece.curve; }
    bool may_span(const std::vector<Piece>&, std::size_t, std::size_t, double, double) const {
        return true;
    }
    int parts_of(const Piece&, double, double) const { return 1; }
    bool agrees(const PlaceKey& from, const PlaceKey& to, double u, const Piece& piece,
                double t) const {
        const double seconds = double{to.time} - double{from.time};
        const Vec3 shown = hermite<Vec3>(from.place, from.rate, to.place, to.rate, seconds, u);
        return (shown + origin - piece.position_at(t)).norm() <= tolerance;
    }
};

/// How orientations are.
struct TurnTrack {
    TurnSplines splines;
    double tolerance;

    TurnKey key(const Piece& piece, double t) const { return turn_key(piece, t); }
    bool goes_on(const Piece& before, const Piece& after) const {
        const double t = after.start;
        return angle_between(before.at(t).orientation.coeffs(), after.orientation.coeffs()) +
                   (after.spin_at(t) - before.spin_at(t)).norm() * float_step(t) <=
               0.5 * tolerance;
    }
    bool is_exact_in(const Piece& piece, double, double) const {
        return splines == TurnSplines::kLinear && has_constant_spin(piece);
    }
    /// Less than half a turn.
    bool may_span(const std::vector<Piece>& pieces, std::size_t first, std::size_t last, double a,
                  double b) const {
        double turn = 0;
        for (std::size_t i = first; i <= last; ++i) {
            const double from = std::max(a, pieces[i].start),
                         to = i == last ? b : pieces[i + 1].start;
            double fastest = 0;
            for (const double u : {0.0, 0.25, 0.5, 0.75, 1.0})
                fastest = std::max(fastest, pieces[i].spin_at(from + u * (to - from)).norm());
            turn += fastest * std::max(0.0, to - from);
        }
        // Equal parts end at floats, which moves them by a rounding.
        return turn <= kMostTurn * (1 + 1e-3);
    }
    /// Equal parts of a piece that turn by less than that, where linear splines are exact.
    int parts_of(const Piece& piece, double a, double b) const {
        constexpr double kMostParts = 1e8;
        if (splines == TurnSplines::kCubic || !has_constant_spin(piece)) return 1;
        return static_cast<int>(
            std::clamp(std::ceil(piece.spin.norm() * (b - a) / kMostTurn), 1.0, kMostParts));
    }
    bool agrees(const TurnKey& from, const TurnKey& to, double u, const Piece& piece,
                double t) const {
        const double sign = from.turn.dot(to.turn) < 0 ? -1 : 1;
        const double seconds = double{to.time} - double{from.time};
        const Eigen::Vector4d end = sign * to.turn, rate = sign * to.rate;
        const Eigen::Vector4d shown =
            splines == TurnSplines::kLinear
                ? Quat(from.turn).slerp(u, Quat(end)).coeffs()
                : hermite<Eigen::Vector4d>(from.turn, from.rate, end, rate, seconds, u)
                      .normalized();
        return angle_between(shown, piece.at(t).orientation.coeffs()) <= tolerance;
    }
};

/// Pieces that go on smoothly, from one float to another.
struct Run {
    std::size_t first_piece = 0, last_piece = 0;
    float first = 0, last = 0;
};

template <class Track>
std::vector<Run> runs_of(const std::vector<Piece>& pieces, double duration_s, const Track& track) {
    std::vector<Run> runs;
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (!runs.empty() && track.goes_on(pieces[i - 1], pieces[i]))
            runs.back().last_piece = i;
        else
            runs.push_back({i, i, at_or_after(pieces[i].start), 0});
    }
    for (std::size_t i = 0; i < runs.size(); ++i)
        runs[i].last = i + 1 < runs.size() ? std::nextafter(runs[i + 1].first, -kInfinity)
                                           : static_cast<float>(duration_s);
    std::erase_if(runs, [](const Run& run) { return run.last < run.first; });
    return runs;
}

/// Keys of a run: at its ends, and between them wherever a spline does not follow the motion.
template <class Track, class Key>
class RunKeys {
  public:
    RunKeys(const std::vector<Piece>& pieces, const Run& run, const Track& track,
            std::vector<Key>& keys)
        : pieces_(pieces), run_(run), track_(track), keys_(keys) {
        put(run.first);
        if (run.last > run.first) between(run.first, run.last, 0);
    }

  private:
    std::size_t piece_at(double t) const {
        const auto begin = pieces_.begin() + static_cast<std::ptrdiff_t>(run_.first_piece);
        const auto end = pieces_.begin() + static_cast<std::ptrdiff_t>(run_.last_piece) + 1;
        const auto after = std::upper_bound(
            begin, end, t, [](double time, const Piece& p) { return time < p.start; });
        return static_cast<std::size_t>((after == begin ? begin : after - 1) - pieces_.begin());
    }
    Key key_at(float t) const { return track_.key(pieces_[piece_at(double{t})], double{t}); }
    void put(float t) { keys_.push_back(key_at(t)); }

    bool fits(float a, float b, std::size_t first, std::size_t last) const {
        if (!track_.may_span(pieces_, first, last, double{a}, double{b})) return false;
        if (first == last && track_.is_exact_in(pieces_[first], double{a}, double{b})) return true;
        const Key from = key_at(a), to = key_at(b);
        const double seconds = double{b} - double{a};
        for (std::size_t i = first; i <= last; ++i) {
            const double begin = std::max(double{a}, pieces_[i].start);
            const double end = i == last ? double{b} : pieces_[i + 1].start;
            for (const double part : kLookedAt) {
                const double t = begin + part * (end - begin);
                if (!track_.agrees(from, to, (t - double{a}) / seconds, pieces_[i], t))
                    return false;
            }
        }
        return true;
    }

    /// Where to halve: at the piece that begins nearest to the middle, if there is one.
    float cut(float a, float b, std::size_t first, std::size_t last) const {
        const double middle = 0.5 * (double{a} + double{b});
        if (first == last) return static_cast<float>(middle);
        const std::size_t i = std::clamp(piece_at(middle), first + 1, last);
        const std::size_t next = std::min(i + 1, last);
        const double nearer =
            std::abs(pieces_[i].start - middle) <= std::abs(pieces_[next].start - middle)
                ? pieces_[i].start
                : pieces_[next].start;
        const float at = at_or_after(nearer);
        return at > a && at < b ? at : static_cast<float>(middle);
    }

    /// The keys after a, that at b included.
    void between(float a, float b, int depth) {
        const std::size_t first = piece_at(double{a}), last = piece_at(double{b});
        const int parts = first == last ? track_.parts_of(pieces_[first], double{a}, double{b}) : 1;
        if (parts > 1) return equal_parts(a, b, parts);
        if (depth == kDeepest || fits(a, b, first, last)) return put(b);
        const float middle = cut(a, b, first, last);
        if (middle <= a || middle >= b) return put(b);
        between(a, middle, depth + 1);
        between(middle, b, depth + 1);
    }
    void equal_parts(float a, float b, int parts) {
        const double seconds = double{b} - double{a};
        float last = a;
        for (int i = 1; i <= parts; ++i) {
            const float t = i == parts ? b : static_cast<float>(double{a} + seconds * i / parts);
            if (t > last) put(t);  // not where parts are shorter than what floats tell apart
            last = t;
        }
    }

    const std::vector<Piece>& pieces_;
    const Run& run_;
    const Track& track_;
    std::vector<Key>& keys_;
};

bool stands(const Piece& piece) {
    return !piece.curve && piece.velocity.isZero(0) && piece.acceleration.isZero(0);
}
bool keeps_its_turn(const Piece& piece) { return has_constant_spin(piece) && piece.spin.isZero(0); }

}  // namespace

std::vector<PlaceKey> place_keys(const Trajectory& ball, double duration_s, const Vec3& origin,
                                 double tolerance_m) {
    const std::vector<Piece>& pieces = ball.pieces();
    if (pieces.size() == 1 && stands(pieces[0])) return {place_key(pieces[0], 0, origin)};
    const PlaceTrack track{origin, tolerance_m};
    std::vector<PlaceKey> keys;
    for (const Run& run : runs_of(pieces, duration_s, track))
        RunKeys<PlaceTrack, PlaceKey>(pieces, run, track, keys);
    return keys;
}

std::vector<TurnKey> turn_keys(const Trajectory& ball, double duration_s, TurnSplines splines,
                               double tolerance) {
    const std::vector<Piece>& pieces = ball.pieces();
    if (std::all_of(pieces.begin(), pieces.end(), [&](const Piece& piece) {
            return keeps_its_turn(piece) &&
                   piece.orientation.coeffs() == pieces[0].orientation.coeffs();
        }))
        return {turn_key(pieces[0], 0)};
    const TurnTrack track{splines, tolerance};
    std::vector<TurnKey> keys;
    for (const Run& run : runs_of(pieces, duration_s, track))
        RunKeys<TurnTrack, TurnKey>(pieces, run, track, keys);
    for (std::size_t i = 1; i < keys.size(); ++i)
        if (keys[i - 1].turn.dot(keys[i].turn) < 0) {
            keys[i].turn = -keys[i].turn;
            keys[i].rate = -keys[i].rate;
        }
    return keys;
}

}  // namespace carom
