// Turns steps into the pieces of a trajectory.
#pragma once

#include <cstdint>

#include "motion/motion.h"
#include "sim/contact/contact.h"

namespace carom {

/// One step of one ball, as a solver made it.
struct Step {
    double start = 0;                  ///< s
    double end = 0;                    ///< s
    Vec3 position = Vec3::Zero();      ///< at the start, m
    Vec3 end_position = Vec3::Zero();  ///< at the end, m
    /// The velocities with which the ball went from start to end: ODE's after the step.
    Velocities mean;
    Velocities before;      ///< ODE's before the step
    bool touching = false;  ///< it had a contact joint
    bool impact = false;    ///< one of them was an impact
};

/// Joins the steps of one ball into as few pieces as say the same.
///
/// ODE's semi-implicit Euler moves a ball from x_n to x_(n+1) = x_n + h v_(n+1), v_(n+1) = v_n + h
/// a. With constant a these points lie on one parabola,
///     p(t) = x_0 + (v_0 + a h / 2) t + a t^2 / 2,
/// so a flight is one piece, and so are uniform sliding and rolling, and rest. A piece's velocity
/// is the derivative of that position. It therefore differs from ODE's step velocity, which is the
/// mean over the step and lags by half a step: v_n = p'(n h) - a h / 2. The spin is treated alike.
///
/// An impact found at t_n (where the balls overlap) is solved by the step from t_n to t_(n+1); the
/// parabola that follows starts at t_n, where the one before it ends, at the same position.
///
/// A step joins the current piece if the piece predicts its end to rounding; the first step that
/// does not begins a new piece at ODE's own position.
class Recorder {
  public:
    /// `radius` [m] sets the scale of what counts as equal.
    Recorder(double radius, const Vec3& gravity) : radius_(radius), gravity_(gravity) {}

    void add(const Step& step);
    /// The pieces so far; the recorder is empty afterwards.
    Trajectory finish();

  private:
    /// How much of the current piece is known.
    enum class Known { kNothing, kOneStep, kAll };

    bool is_free(const Step& step) const;
    bool extend_one_step(const Step& step, bool free);
    bool predicted(const Step& step, bool free) const;
    void begin(const Step& step, bool free);
    void close();
    bool turn_is_exact(double seconds) const;

    double radius_;
    Vec3 gravity_;
    Trajectory trajectory_;
    Piece piece_;
    Velocities first_mean_;    ///< of the piece's first step
    double first_length_ = 0;  ///< s
    Known known_ = Known::kNothing;
    bool free_ = false;       ///< only gravity acts in the piece
    std::int64_t steps_ = 0;  ///< in the piece
};

}  // namespace carom
