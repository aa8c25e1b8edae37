// The world of the method `exact` between two events: balls, and who touches whom.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "sim/collide/neighbour_grid.h"
#include "sim/collide/neighbour_lists.h"
#include "sim/collide/surface_tree.h"
#include "sim/collide/time_of_impact.h"
#include "sim/contact/contact.h"
#include "sim/contact/restitution.h"
#include "sim/world/exact_balls.h"

namespace carom {

/// Scene, balls and the geometry of who touches whom.
class ExactWorld : public ExactBalls {
  public:
    explicit ExactWorld(const Scene& scene);

    PairTable pairs;

    const Surface& surface(int i) const { return scene.surfaces[static_cast<std::size_t>(i)]; }
    std::string name(const Partner& partner) const;

    double place_rounding = 0;  ///< m: of the places that the scene came with (ExactOptions)
    /// Two things touch when their gap is not above the rounding of their places: that of the
    /// scene's own, and ...
    double touch_tolerance(const Vec3& a, const Vec3& b, double size) const {
        return place_rounding + motion_tolerance(a, b, size);
    }
    /// ... that of places which the motion itself has led to, m.
    static double motion_tolerance(const Vec3& a, const Vec3& b, double size) {
        // Places are made of a few operations on numbers of their size.
        constexpr double kTouchRounding = 64 * std::numeric_limits<double>::epsilon();
        return kTouchRounding * (a.cwiseAbs().maxCoeff() + b.cwiseAbs().maxCoeff() + size);
    }
    /// Which of the two counts for ball i and a partner at t: of what has not moved since the start
    /// the scene's own places are all that is known.
    double touch_tolerance(int i, const Partner& partner, double t, const Vec3& a, const Vec3& b,
                           double size) const {
        const bool as_placed =
            is_as_placed(i, t) && (partner.is_surface || is_as_placed(partner.index, t));
        return (as_placed ? place_rounding : 0) + motion_tolerance(a, b, size);
    }
    /// The contact of ball i with a partner at t, as geometry has it; of two balls, the scene's
    /// first one is `ball`.
    Contact contact_at(int i, const Partner& partner, double t) const;
    /// The same with a surface, for ball i with its centre at x [m].
    Contact surface_contact(int i, int surface, const Vec3& x) const;
    bool touches(const Contact& contact, double t) const;
    PairProperties pair(int material_a, int material_b) const;
    /// Of a ball and what it may meet; null for none.
    const ContactLaws* laws_between(int i, const Partner& partner) const {
        const int other =
            partner.is_surface ? surface(partner.index).material : ball(partner.index).material;
        return pair(ball(i).material, other).laws;
    }

    /// Whether balls have to look at each other at all, and why (not).
    bool balls_can_meet = true;
    /// Who is near whom: by cells where balls fly far between impacts, by lists where they do not.
    /// Neither while balls are few: then each looks at all others.
    std::optional<NeighbourGrid> grid;
    std::optional<NeighbourLists> lists;
    void find_neighbours(double t, bool by_lists);
    /// Builds both anew where balls have spread or gathered so far that they do not fit any more,
    /// or the other one is wanted. Whether it did: then all predictions have to be made anew.
    bool refit_neighbours(double t, bool by_lists);
    bool finds_neighbours() const { return grid || lists; }
    /// Whether a ball is found by where it stands: those that are much larger than the rest are
    /// not.
    bool has_place(int i) const {
        return lists ? lists->grid().in_cell(i) : grid && grid->in_cell(i);
    }
    /// Where a ball that has a place may go before it has to be given another one, m.
    Box3 place_of(int i) const;
    /// The ball is given the place that it is in at t, if it is in another one.
    void follow(int i, double t);

    /// Calls f(other) for every ball that could touch `ball`, and maybe for more. An impact asks
    /// twice for the balls near it: once who else is touched, then what comes next.
    template <class F>
    void for_each_near(int ball_index, F&& f) const {
        if (!balls_can_meet) return;
        if (lists && lists->grid().in_cell(ball_index)) {
            for (const int other : lists->grid().large()) f(other);
            for (const int other : lists->of(ball_index)) fetch_glance(other);
            for (const int other : lists->of(ball_index)) f(other);
            return;
        }
        if (grid) {
            for (const int other : near(ball_index)) f(other);
            return;
        }
        for (int other = 0; other < static_cast<int>(balls.size()); ++other)
            if (other != ball_index) f(other);
    }
    /// The same for every ball that stands where it touches one of this radius at x, where `ball`
    /// is now.
    template <class F>
    void for_each_touching(int ball_index, const Vec3& x, double radius, F&& f) const {
        if (balls_can_meet && finds_neighbours())
            (lists ? lists->grid() : *grid).for_each_touching(ball_index, x, radius, f);
        else
            for_each_near(ball_index, f);
    }

    /// The same for the layer of cells that a ball has come to.
    template <class F>
    void for_each_in_layer(int ball_index, int axis, std::int64_t side, F&& f) const {
        NearList& list = next_list();
        list.ball = -1;
        list.others.clear();
        grid->for_each_in_layer(ball_index, axis, side, [&](int other) { add_to(list, other); });
        for (const int other : list.others) f(other);
    }

    std::vector<int> planes, bounded_surfaces;  ///< the surfaces of both kinds, ascending
    /// Empty while bounded surfaces are few: then a ball looks at all of them.
    std::optional<SurfaceTree> surface_tree;

    /// m: what is farther than this from a ball's centre is no partner of it now.
    double reach(int i) const;
    void build_surface_tree();

    /// Calls f(surface), ascending, for every surface within `reach` of x, where ball i is now, and
    /// maybe for more.
    template <class F>
    void for_each_surface_near(int i, const Vec3& x, double reach, F&& f) const {
        if (!surface_tree) {
            for (int s = 0; s < static_cast<int>(scene.surfaces.size()); ++s) f(s);
            return;
        }
        std::vector<int>& found = next_surface_list();
        const Box3 box = SurfaceTree::widened(Box3(x), reach);
        if (!clear_[static_cast<std::size_t>(i)].contains(box))
            surface_tree->find_near(Box3(x), reach, found);
        merge_planes(found);
        for (const int s : found) f(s);
    }
    /// The same for the bounded ones that ball i may come to from t on, in so many seconds on its
    /// piece.
    template <class F>
    void for_each_surface_ahead(int i, double t, double seconds, F&& f) const {
        if (!surface_tree) {
            for (const int s : bounded_surfaces) f(s);
            return;
        }
        std::vector<int>& found = next_surface_list();
        find_surfaces_ahead(i, t, seconds, found);
        for (const int s : found) f(s);
    }

  private:
    bool is_as_placed(int i, double t) const {
        const Piece& p = ball(i).piece;
        return t == 0 || (p.start == 0 && p.velocity.isZero(0) && p.acceleration.isZero(0));
    }
    std::vector<int>& next_surface_list() const {
        at_surface_list_ = (at_surface_list_ + 1) % surface_lists_.size();
        surface_lists_[at_surface_list_].clear();
        return surface_lists_[at_surface_list_];
    }
    void merge_planes(std::vector<int>& found) const;
    void find_surfaces_ahead(int i, double t, double seconds, std::vector<int>& found) const;

    struct NearList {
        int ball = -1;
        std::int64_t moves = 0;  ///< of the grid, when it was made
        std::vector<int> others;
    };

    /// Where balls are many, most of an event is waiting for memory: it is on its way when the
    /// first ball of a list is looked at.
    void add_to(NearList& list, int other) const {
        fetch_glance(other);
        list.others.push_back(other);
    }
    NearList& next_list() const {
        at_list_ = (at_list_ + 1) % near_lists_.size();
        return near_lists_[at_list_];
    }
    const std::vector<int>& near(int ball_index) const;
    void set_pair(Contact& contact, int material) const;

    mutable std::array<NearList, 4> near_lists_;  ///< the last ones, in turn
    mutable std::size_t at_list_ = 0;
    /// Per ball, a box where no bounded surface is: that of its last flight that met none. The next
    /// one, and what it touches in the end, most often lies inside.
    mutable std::vector<Box3> clear_;
    mutable std::array<std::vector<int>, 4> surface_lists_;  ///< of walks inside one another
    mutable std::size_t at_surface_list_ = 0;
    std::vector<PairProperties> pair_cache_;  ///< materials x materials, empty if they are many
};

/// Relative speed along the normal at which two touching bodies count as neither approaching nor
/// separating: rounding of their velocities.
inline constexpr double kStillFraction = 1e-13;

}  // namespace carom
