#include "sim/collide/conservative_advancement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/infinity.h"
#include "geometry/feature.h"
#include "geometry/feature_side.h"
#include "geometry/gap_bound.h"
#include "sim/math/bracketed_root.h"

namespace carom {

namespace {

/// Gaps of this fraction of the numbers that make them up are rounding.
constexpr double kPlaceRounding = 16 * std::numeric_limits<double>::epsilon();

/// Rates of a gap below this fraction of the speed are rounding of a zero, as in the other files of
/// times of impact.
constexpr double kStill = 2e-14;

/// Steps converge quadratically; many are only taken along a gap that stays small.
constexpr int kMostSteps = 100'000;

/// A parabola, and what the bounds need of it.
class Parabola {
  public:
    Parabola(const Path& path, double end)
        : path_(path), end_(end), pull_(path.acceleration.norm()) {}

    double end() const { return end_; }
    Vec3 at(double s) const { return path_.at(s); }
    /// From the start on.
    Vec3 way(double s) const { return s * (path_.velocity + (0.5 * s) * path_.acceleration); }
    Vec3 velocity(double s) const { return path_.velocity + s * path_.acceleration; }
    Vec3 acceleration(double) const { return path_.acceleration; }
    /// No acceleration is larger, m/s^2.
    double pull() const { return pull_; }
    /// No acceleration along n is smaller.
    double least_along(const Vec3& n) const { return n.dot(path_.acceleration); }

  private:
    const Path& path_;
    double end_, pull_;
};

/// The same of a piece of high degree.
class HighDegree {
  public:
    explicit HighDegree(const HighDegreePath& path) : path_(path) {
        for (std::size_t i = 2; i < path.c.size(); ++i) pull_ += factor(i) * path.c[i].norm();
        pull_ /= path.seconds * path.seconds;
    }

    double end() const { return path_.seconds; }
    Vec3 at(double s) const { return path_.at(s / path_.seconds); }
    Vec3 way(double s) const {
        const double u = s / path_.seconds;
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = path_.c.size(); i-- > 1;) sum = path_.c[i] + u * sum;
        return u * sum;
    }
    Vec3 velocity(double s) const {
        const double u = s / path_.seconds;
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = path_.c.size(); i-- > 1;)
            sum = static_cast<double>(i) * path_.c[i] + u * sum;
        return sum / path_.seconds;
    }
    Vec3 acceleration(double s) const {
        const double u = s / path_.seconds;
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = path_.c.size(); i-- > 2;) sum = factor(i) * path_.c[i] + u * sum;
        return sum / (path_.seconds * path_.seconds);
    }
    double pull() const { return pull_; }
    double least_along(const Vec3& n) const {
        double least = factor(2) * n.dot(path_.c[2]);
        for (std::size_t i = 3; i < path_.c.size(); ++i)
            least += factor(i) * std::min(n.dot(path_.c[i]), 0.0);
        return least / (path_.seconds * path_.seconds);
    }

  private:
    static double factor(std::size_t i) { return static_cast<double>(i * (i - 1)); }

    const HighDegreePath& path_;
    double pull_ = 0;
};

/// The first h > 0 with gap + rate h - closing h^2 / 2 = 0, for a gap >= 0; infinite where there is
/// none.
double first_zero(double gap, double rate, double closing) {
    if (closing == 0) return rate < 0 ? -gap / rate : kInfinity;
    const double discriminant = rate * rate + 2 * closing * gap;
    if (closing < 0 && (rate >= 0 || discriminant < 0)) return kInfinity;
    const double root = std::sqrt(discriminant);
    return rate < 0 ? 2 * gap / (root - rate) : (rate + root) / closing;
}

template <class Shape, class Course>
class Advancement {
  public:
    Advancement(const Course& course, double radius, const Shape& shape, bool touching)
        : course_(course), shape_(shape), radius_(radius), touching_(touching) {
        if (!touching) return;
        const CenterMotion center{course.at(0), course.velocity(0), course.acceleration(0)};
        none_ = nearest_on(shape, center.x, radius).gap;
        held_ = feature_at(SurfaceShape(shape), center, radius);
    }

    TimeOfImpact first_impact() {
        bool starts = touching_;
        if (touching_) {
            const Look now = look(0);
            if (now.rate <= kStill * course_.velocity(0).norm()) {
                if (is_pressed()) return {ImpactState::kPressed, 0};
                starts = false;
            }
        }
        double s = 0, above = 0, near_step = 0;
        for (int i = 0; i < kMostSteps; ++i) {
            const Look now = look(s);
            if (now.gap < -now.rounding)
                return {ImpactState::kHit,
                        bracketed_root([this](double t) { return gap(t); }, above, s)};
            if (now.gap >= 0) above = s;
            if (!(s < course_.end())) return {};
            // Where the gap is 0 to rounding, steps grow until it is not any more.
            double step = 0;
            if (now.gap > now.rounding || starts) {
                step = safe_step(s, now);
                near_step = 0;
                starts = false;
                if (step >= course_.end() - s) return {};
            } else {
                near_step = near_step > 0 ? 2 * near_step : step_near(now);
            }
            // At least to the next double.
            const double next = s + std::max(step, near_step);
            s = next > s ? next : std::nextafter(s, kInfinity);
            s = std::min(s, course_.end());
        }
        return {ImpactState::kCapped, 0};
    }

  private:
    struct Look {
        GapBound bound;
        double gap = 0, rate = 0, speed = 0;
        double rounding = 0;        ///< of the gap, m
        double place_rounding = 0;  ///< of the place, m
    };

    Look look(double s) const {
        const Vec3 x = course_.at(s), v = course_.velocity(s);
        Look l;
        l.bound = gap_bound(shape_, x, radius_);
        l.rate = l.bound.normal.dot(v);
        l.speed = v.norm();
        l.place_rounding = kPlaceRounding * (course_.at(0).cwiseAbs().maxCoeff() +
                                             x.cwiseAbs().maxCoeff() + l.speed * s + radius_);
        l.rounding = l.place_rounding;
        if (is_over_held(x)) {
            const Vec3 way = course_.way(s);
            l.gap = held_.gap_growth(course_.at(0), way);
            l.rounding *= std::min(1.0, way.norm() / radius_);
        } else {
            l.gap = l.bound.gap - none_;
        }
        return l;
    }
    double gap(double s) const {
        const Vec3 x = course_.at(s);
        if (is_over_held(x)) return held_.gap_growth(course_.at(0), course_.way(s));
        return nearest_on(shape_, x, radius_).gap - none_;
    }

    /// Whether a ball that touches now is still where the same feature is the nearest: there its
    /// gap is known to more digits than its place.
    bool is_over_held(const Vec3& x) const {
        if (!touching_) return false;
        const double border = kBorder * (x.cwiseAbs().maxCoeff() + radius_);
        for (int i = 0; i < held_.border_count; ++i)
            if (held_.borders[static_cast<std::size_t>(i)].margin(x) < -border) return false;
        return true;
    }

    /// Touching, and neither apart nor together: whether the second rate of the gap is negative.
    bool is_pressed() const {
        const FeatureMotion motion = held_.motion_at(course_.at(0), course_.velocity(0));
        return motion.normal.dot(course_.acceleration(0)) +
                   motion.turning_speed.dot(motion.normal_rate) <
               0;
    }

    /// For so long the gap stays open.
    double safe_step(double s, const Look& now) const {
        // In so long the speed at most doubles, or the gap would close by what pulls.
        const double pull = course_.pull(), left = course_.end() - s;
        double h = left;
        if (pull > 0) h = std::min(h, (now.speed + std::sqrt(pull * now.gap)) / pull);
        const double speed = now.speed + h * pull;
        const double by_speed = now.gap / speed;
        if (now.bound.within < kInfinity) h = std::min(h, now.bound.within / speed);
        const double closing =
            now.bound.bend * speed * speed - course_.least_along(now.bound.normal);
        // A convex body's bound holds as far as one likes.
        if (now.bound.bend == 0 && !(now.bound.within < kInfinity)) h = left;
        return std::max(by_speed, std::min(h, first_zero(now.gap, now.rate, closing)));
    }

    /// For so long the gap stays within a few roundings of places.
    double step_near(const Look& now) const {
        const double closing = std::abs(course_.least_along(now.bound.normal)) +
                               now.bound.bend * now.speed * now.speed;
        const double rate = std::abs(now.rate), room = 4 * now.place_rounding;
        return 2 * room / (rate + std::sqrt(rate * rate + 2 * closing * room));
    }

    const Course& course_;
    const Shape& shape_;
    double radius_;
    bool touching_;
    double none_ = 0;  ///< what touches has this gap, which counts as 0, m
    Feature held_;     ///< that it touches
};

}  // namespace

template <class Shape>
TimeOfImpact advance_to_impact(const Path& ball, double radius, const Shape& shape, bool touching,
                               double horizon) {
    const Parabola course(ball, horizon);
    return Advancement<Shape, Parabola>(course, radius, shape, touching).first_impact();
}

template <class Shape>
TimeOfImpact advance_to_impact(const HighDegreePath& ball, double radius, const Shape& shape,
                               bool touching) {
    const HighDegree course(ball);
    return Advancement<Shape, HighDegree>(course, radius, shape, touching).first_impact();
}

template TimeOfImpact advance_to_impact(const Path&, double, const CylinderShape&, bool, double);
template TimeOfImpact advance_to_impact(const HighDegreePath&, double, const CylinderShape&, bool);
template TimeOfImpact advance_to_impact(const Path&, double, const RingShape&, bool, double);
template TimeOfImpact advance_to_impact(const HighDegreePath&, double, const RingShape&, bool);
template TimeOfImpact advance_to_impact(const Path&, double, const BowlShape&, bool, double);
template TimeOfImpact advance_to_impact(const HighDegreePath&, double, const BowlShape&, bool);
template TimeOfImpact advance_to_impact(const Path&, double, const PipeShape&, bool, double);
template TimeOfImpact advance_to_impact(const HighDegreePath&, double, const PipeShape&, bool);

}  // namespace carom
