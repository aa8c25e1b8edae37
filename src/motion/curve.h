// What a piece adds to its parabola where its motion has no closed form, as polynomials of
// degree 8.
#pragma once

#include <array>
#include <memory>

#include "core/types.h"

namespace carom {

/// With u = s / seconds, s counted from the start of the piece, a curve adds
///   u^3 (c[0] + c[1] u + ... + c[5] u^5)
/// to the position [m] and to the turn [rad].
struct Curve {
    using Terms = std::array<Vec3, 6>;

    double seconds = 1;  ///< length of the piece, where its motion is known
    Terms position;
    Terms turn;

    Curve() {
        position.fill(Vec3::Zero());
        turn.fill(Vec3::Zero());
    }
};

/// The value of terms, and of their first and second derivative by s.
Vec3 curve_value(const Curve::Terms& terms, double u);
Vec3 curve_rate(const Curve::Terms& terms, double u, double seconds);
Vec3 curve_second_rate(const Curve::Terms& terms, double u, double seconds);

/// w of q' = w q / 2 for q = exp(turn): w = turn' + (1 - cos x)/x^2 turn x turn'
/// + (x - sin x)/x^3 turn x (turn x turn'), x = |turn| (A. Iserles, H. Munthe-Kaas, S. P. Norsett,
/// A. Zanna, "Lie-group methods", Acta Numerica 9, 2000, appendix B).
Vec3 spin_of_turn(const Vec3& turn, const Vec3& turn_rate);

/// A curve, or none: a value that is copied with its owner. Most pieces have none, and pay for a
/// pointer.
class OptionalCurve {
  public:
    OptionalCurve() = default;
    explicit OptionalCurve(const Curve& curve) : curve_(std::make_unique<const Curve>(curve)) {}
    ~OptionalCurve() = default;
    OptionalCurve(const OptionalCurve& other) : curve_(copy_of(other)) {}
    OptionalCurve(OptionalCurve&&) noexcept = default;
    OptionalCurve& operator=(const OptionalCurve& other) {
        if (curve_ || other.curve_) curve_ = copy_of(other);
        return *this;
    }
    OptionalCurve& operator=(OptionalCurve&&) noexcept = default;

    explicit operator bool() const { return curve_ != nullptr; }
    const Curve& operator*() const { return *curve_; }
    const Curve* operator->() const { return curve_.get(); }

  private:
    static std::unique_ptr<const Curve> copy_of(const OptionalCurve& other) {
        return other.curve_ ? std::make_unique<const Curve>(*other.curve_) : nullptr;
    }

    std::unique_ptr<const Curve> curve_;
};

}  // namespace carom
