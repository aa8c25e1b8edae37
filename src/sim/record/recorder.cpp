#include "sim/record/recorder.h"

#include <cmath>
#include <limits>

namespace carom {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// Positions this close, relative to where the ball is, count as equal. A thousandth of what a
/// frame could ever show, and above the noise of a solved contact.
constexpr double kSamePosition = 1e-12;

/// Spins this close, relative to the ball's fastest point, count as equal.
constexpr double kSameSpin = 1e-11;

/// A step may lose this many last digits of position and of velocity: two roundings each.
constexpr double kRoundingPerStep = 2 * kEpsilon;

/// A velocity change above this many times what gravity does in a step is a kink, not a curve:
/// forces of lasting contacts are of gravity's order, impulses are not.
constexpr double kKink = 20;

/// Error allowed to a piece's closed form of orientation, rad. A turning ball does a thousand
/// pieces a second where this binds: 1e-8 rad a second.
constexpr double kTurnError = 1e-11;

}  // namespace

/// Only gravity acted, even if a contact joint was there: after an impact the balls separate for
/// a step or two while they still overlap, and the joint does nothing.
bool Recorder::is_free(const Step& step) const {
    if (!step.touching) return true;
    if (step.impact || step.mean.spin != step.before.spin) return false;
    const Vec3 change = step.mean.linear - step.before.linear;
    const Vec3 expected = (step.end - step.start) * gravity_;
    const double rounding = 4 * kEpsilon * (step.mean.linear.norm() + expected.norm());
    return (change - expected).norm() <= rounding;
}

void Recorder::add(const Step& step) {
    const bool free = is_free(step);
    const bool joined = known_ == Known::kAll       ? predicted(step, free)
                        : known_ == Known::kOneStep ? extend_one_step(step, free)
                                                    : false;
    if (joined) {
        ++steps_;
        return;
    }
    close();
    begin(step, free);
}

Trajectory Recorder::finish() {
    close();
    known_ = Known::kNothing;
    return std::move(trajectory_);
}

void Recorder::begin(const Step& step, bool free) {
    Piece next;
    next.start = step.start;
    next.position = step.position;
    if (known_ != Known::kNothing) next.orientation = piece_.at(step.start).orientation;
    next.velocity = step.mean.linear;
    next.spin = step.mean.spin;
    piece_ = next;
    first_mean_ = step.mean;
    first_length_ = step.end - step.start;
    known_ = Known::kOneStep;
    free_ = false;
    steps_ = 1;
    if (!free) return;
    // v_n + a h / 2 = v_(n+1) - a h / 2
    piece_.acceleration = gravity_;
    piece_.velocity -= (0.5 * first_length_) * gravity_;
    known_ = Known::kAll;
    free_ = true;
}

/// The second step decides how a piece that began in contact is curved.
bool Recorder::extend_one_step(const Step& step, bool free) {
    if (step.impact) return false;
    const double between = 0.5 * (first_length_ + step.end - step.start);
    const Vec3 change = step.mean.linear - first_mean_.linear;
    const Vec3 spin_change = step.mean.spin - first_mean_.spin;
    if (free && !spin_change.isZero(0)) return false;
    const double rounding = 16 * kEpsilon * step.mean.linear.norm();
    if (change.norm() > kKink * between * gravity_.norm() + rounding) return false;

    piece_.acceleration = free ? gravity_ : Vec3(change / between);
    piece_.spin_rate = spin_change / between;
    piece_.velocity = first_mean_.linear - (0.5 * first_length_) * piece_.acceleration;
    piece_.spin = first_mean_.spin - (0.5 * first_length_) * piece_.spin_rate;
    known_ = Known::kAll;
    free_ = free;
    return turn_is_exact(step.end - piece_.start);
}

bool Recorder::predicted(const Step& step, bool free) const {
    if (step.impact || free != free_) return false;
    const double s = step.end - piece_.start;
    const Vec3 position = piece_.position + s * (piece_.velocity + (0.5 * s) * piece_.acceleration);
    const double size = step.end_position.cwiseAbs().maxCoeff();
    const double speed = step.mean.linear.cwiseAbs().maxCoeff();
    // n roundings of x, and n of v, each of which then acts for up to the whole time.
    const double rounding = kRoundingPerStep * static_cast<double>(steps_) * (size + speed * s);
    const double tolerance = kSamePosition * (size + radius_) + rounding;
    if (!((position - step.end_position).cwiseAbs().maxCoeff() <= tolerance)) return false;
    if (free) return step.mean.spin == piece_.spin;

    const double middle = s - 0.5 * (step.end - step.start);
    const Vec3 spin_error = piece_.spin + middle * piece_.spin_rate - step.mean.spin;
    const double spin_size = step.mean.spin.norm() + speed / radius_;
    const double spin_tolerance =
        (kSameSpin + kRoundingPerStep * static_cast<double>(steps_)) * spin_size;
    return spin_error.norm() <= spin_tolerance && turn_is_exact(s);
}

/// Piece::at() takes Magnus' series to fourth order. The next terms, about the middle spin m with
/// rate b, are of size |m|^2 |m x b| s^5 / 720 and |b| |m x b| s^5 / 240 (Blanes, Casas, Oteo, Ros,
/// "The Magnus expansion and some of its applications", Physics Reports 470, 2009, section 5.4).
bool Recorder::turn_is_exact(double seconds) const {
    const double cross = piece_.spin.cross(piece_.spin_rate).norm();
    const double spin = piece_.spin.norm(), rate = piece_.spin_rate.norm();
    if (cross <= kSameSpin * spin * rate) return true;
    const double largest = spin + seconds * rate;
    const double s2 = seconds * seconds;
    const double error = cross * s2 * s2 * seconds * (largest * largest / 720 + rate / 240);
    return error <= kTurnError;
}

void Recorder::close() {
    if (known_ != Known::kNothing) trajectory_.append(piece_);
}

}  // namespace carom
