// How far a motion reaches: what a camera has to hold.
#pragma once

#include <vector>

#include "core/types.h"
#include "motion/motion.h"
#include "scene/scene.h"

namespace carom {

/// Everything that a camera has to hold: the exact paths of the balls from film.start to the end of
/// the motion, the bounded surfaces near them and the floor below them.
///
/// Three rules keep the extent sensible; all else counts in full, however far it goes:
/// - A ball that flies or rolls away after its last event counts until it is kDepartureRadii radii,
///   or once the size of all that happened before, outside of what happened before.
/// - A motion without any event counts to kFlightRadii radii around the balls' starts.
/// - A surface counts as far as it lies in the balls' box grown by half the box's size.
class MotionExtent {
  public:
    static constexpr double kDepartureRadii = 150;  ///< a ball is still some pixels wide there
    static constexpr double kFlightRadii = 1000;    ///< a ball is still about one pixel wide there

    MotionExtent(const Scene& scene, const Motion& motion);

    /// The largest n . p over all points, balls with their radius; n need not be a unit vector.
    double support(const Vec3& n) const;
    /// The same over the balls, and over the surfaces that reach up to `above_m`.
    double upright_support(const Vec3& n, double above_m) const;
    /// The ball whose path has the largest n . p; -1 if there is none.
    int outermost_ball(const Vec3& n) const;

    const Eigen::AlignedBox3d& ball_box() const { return ball_box_; }  ///< with radii
    double largest_radius() const { return largest_radius_; }
    /// The greatest height that the lowest point of any ball reaches, m.
    double highest_bottom() const { return highest_bottom_; }

  private:
    /// p + v s + a s^2 / 2 for s in [0, duration], with a radius around it.
    struct Arc {
        Vec3 p, v, a;
        double duration;
        double radius;
        int ball;
        double support(const Vec3& n) const;
    };
    struct Blob {
        Vec3 center;
        double radius;
        double top;  ///< z of the highest point of the surface that it belongs to
    };

    /// Arcs that count in full, and those that a ball flies after its last event.
    struct Sorted {
        std::vector<std::vector<Arc>> before, after;
        bool any_event = false;
    };

    Sorted sort_arcs(const Scene& scene, const Motion& motion) const;
    void cut_departures(const Sorted& arcs);
    void keep(const Arc& arc);
    void add_surface(const std::vector<Blob>& blobs);
    void add_surfaces(const Scene& scene);
    void add_floor_below(const Scene& scene, const Motion& motion);

    std::vector<Arc> arcs_;
    std::vector<Blob> blobs_;
    Eigen::AlignedBox3d ball_box_;
    double largest_radius_ = 0;
    double highest_bottom_ = 0;
};

}  // namespace carom
