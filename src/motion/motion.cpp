#include "motion/motion.h"

#include <algorithm>
#include <utility>

#include "core/check.h"
#include "core/checksum.h"

namespace carom {

namespace {

/// Room that a trajectory begins with: hardly any has one piece only.
constexpr std::size_t kFirstPieces = 8;

/// exp(v) as a quaternion: a turn by |v| rad about v.
Quat rotation(const Vec3& v) {
    const double angle = v.norm();
    if (angle == 0) return Quat::Identity();
    return Quat(Eigen::AngleAxisd(angle, v / angle));
}

}  // namespace

BallState Piece::at(double t) const {
    const double s = t - start;
    BallState state;
    state.position = position_at(t);
    state.velocity = velocity_at(t);
    state.spin = spin_at(t);
    const Vec3 turned =
        curve ? curved_turn(s)
              : Vec3(s * (spin + (0.5 * s) * spin_rate) - (s * s * s / 12) * spin.cross(spin_rate));
    state.orientation =
        turned.isZero(0) ? orientation : (rotation(turned) * orientation).normalized();
    return state;
}

Vec3 Piece::curved_turn(double s) const {
    return s * (spin + (0.5 * s) * spin_rate) + curve_value(curve->turn, s / curve->seconds);
}

Vec3 Piece::curved_spin(double s) const {
    const Vec3 rate =
        spin + s * spin_rate + curve_rate(curve->turn, s / curve->seconds, curve->seconds);
    return spin_of_turn(curved_turn(s), rate);
}

double Piece::largest_acceleration() const {
    double sum = acceleration.norm();
    if (!curve) return sum;
    double k = 0;
    for (const Vec3& term : curve->position) {
        sum += (k + 3) * (k + 2) * term.norm() / (curve->seconds * curve->seconds);
        ++k;
    }
    return sum;
}

const char* event_kind_name(EventKind kind) {
    switch (kind) {
        case EventKind::kImpact:
            return "impact";
        case EventKind::kSlide:
            return "slide";
        case EventKind::kRoll:
            return "roll";
        case EventKind::kRest:
            return "rest";
        case EventKind::kLeave:
            return "leave";
    }
    return "";
}

void Trajectory::append(Piece piece) {
    if (!pieces_.empty()) {
        CAROM_CHECK(piece.start, >=, last_start_);
        if (piece.start == last_start_) pieces_.pop_back();
    }
    last_start_ = piece.start;
    if (pieces_.size() == pieces_.capacity())
        pieces_.reserve(std::max(kFirstPieces, 2 * pieces_.size()));
    pieces_.push_back(std::move(piece));
}

void Trajectory::let_go_before(double t) {
    constexpr std::size_t kFew = 16;
    if (pieces_.size() < kFew) return;
    // Half of them at least, so that each is moved once.
    const std::size_t index = piece_index(t);
    if (2 * index < pieces_.size()) return;
    pieces_.erase(pieces_.begin(), pieces_.begin() + static_cast<std::ptrdiff_t>(index));
}

std::size_t Trajectory::piece_index(double t) const {
    CAROM_CHECK(pieces_.size(), >, 0u);
    const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), t,
                                        [](double time, const Piece& p) { return time < p.start; });
    return after == pieces_.begin() ? 0 : static_cast<std::size_t>(after - pieces_.begin()) - 1;
}

BallState Trajectory::at(double t) const { return pieces_[piece_index(t)].at(t); }

std::uint64_t Motion::hash() const {
    Checksum checksum;
    const auto add = [&checksum](double value) {
        const double plain = value == 0 ? 0.0 : value;  // -0 and 0 are one value
        checksum.add(&plain, sizeof plain);
    };
    const auto add_vector = [&add](const Vec3& v) {
        for (int i = 0; i < 3; ++i) add(v[i]);
    };

    add(duration);
    for (const Trajectory& ball : balls) {
        add(static_cast<double>(ball.pieces().size()));
        for (const Piece& p : ball.pieces()) {
            add(p.start);
            for (const Vec3& v : {p.position, p.velocity, p.acceleration, p.spin, p.spin_rate})
                add_vector(v);
            for (int i = 0; i < 4; ++i) add(p.orientation.coeffs()[i]);
            if (!p.curve) continue;
            add(p.curve->seconds);
            for (const Curve::Terms& terms : {p.curve->position, p.curve->turn})
                for (const Vec3& term : terms) add_vector(term);
        }
    }
    for (const Event& e : events) {
        for (double v : {e.time, double(e.ball), double(e.other.is_surface), double(e.other.index),
                         double(e.kind), e.approach_speed, e.separation_speed, e.restitution,
                         e.impulse, e.tangential_impulse})
            add(v);
        add_vector(e.point);
        add_vector(e.normal);
    }
    return checksum.value();
}

}  // namespace carom
