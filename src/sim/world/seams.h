// Surfaces that touch each other are one surface to a ball: flush boxes, tiles, capsules in line,
// planes that cross boxes, edges that two boxes share.
//
// Where several surfaces meet a ball in the same place, with the same normal, one of them holds it:
// the one whose feature, to which the motion leads, bends away the least. A centre that goes by v
// around a feature at the distance d needs the acceleration -|v across|^2 / d along the normal (0
// on a face, -v^2 / R on an edge), and of several such bounds on one acceleration the largest
// counts.
#pragma once

#include <optional>
#include <vector>

#include "sim/law/single_contact.h"
#include "sim/world/exact_world.h"

namespace carom {

/// One ball's contact with a surface, and the feature that its motion leads to.
struct SurfaceContact {
    Contact contact;
    SingleContact feature;
};

/// Whether two contacts of one ball with surfaces are the same place: two faces of one plane, or an
/// edge, corner or curve that stands out of the other surface by no more than the rounding of
/// places. A bump of height h is met with a normal that is turned by sqrt(2 h / R).
bool same_place(const ExactWorld& world, const Contact& a, const Contact& b);

/// The surface that goes on where the one that holds a ball ends, or bends away; none if that one
/// goes on itself. The ball is at `x` [m]; `held` is its contact there.
std::optional<SurfaceContact> goes_on_with(const ExactWorld& world, const Contact& held,
                                           const Vec3& x, const Velocities& velocities);

/// Whether a ball keeps out of a surface by itself from `from` to `until` [s] on its present piece,
/// up to the rounding of places.
bool keeps_out(const ExactWorld& world, int ball, int surface, double from, double until);

/// Leaves of contacts[first ...], all of one ball at `x` with surfaces, one for each place: what
/// approaches counts before what does not, then what holds. `dropped(gone, kept)` is told of
/// others.
template <class Dropped>
void merge_places(const ExactWorld& world, const Vec3& x, const Velocities& velocities,
                  std::vector<Contact>& contacts, std::size_t first, Dropped&& dropped);

/// Adds the borders of the features of other surfaces that meet the ball in the same place: where
/// one of them ends, who holds the ball has to be decided anew. The borders that the ball is on are
/// moved out by their width.
void add_borders_of_others(const ExactWorld& world, const Contact& held, const ContactState& at,
                           SingleContact& feature);

// ---- Implementation
// ------------------------------------------------------------------------------

/// Whether of two contacts in the same place `a` counts rather than `b`.
bool holds_before(const ExactWorld& world, const Contact& a, const Contact& b, const Vec3& x,
                  const Velocities& velocities);

/// Gives a contact that holds a ball by a face the face's own normal: over a seam, rounding may put
/// the ball beyond the borders of both sides.
void lay_flat(const ExactWorld& world, Contact& contact, const Vec3& x,
              const Velocities& velocities);

template <class Dropped>
void merge_places(const ExactWorld& world, const Vec3& x, const Velocities& velocities,
                  std::vector<Contact>& contacts, std::size_t first, Dropped&& dropped) {
    for (std::size_t i = first; i < contacts.size(); ++i) {
        if (!contacts[i].other.is_surface) continue;
        for (std::size_t j = i + 1; j < contacts.size();) {
            if (!contacts[j].other.is_surface || !same_place(world, contacts[i], contacts[j])) {
                ++j;
                continue;
            }
            if (holds_before(world, contacts[j], contacts[i], x, velocities))
                std::swap(contacts[i], contacts[j]);
            lay_flat(world, contacts[i], x, velocities);
            dropped(contacts[j], contacts[i]);
            contacts.erase(contacts.begin() + static_cast<std::ptrdiff_t>(j));
        }
    }
}

}  // namespace carom
