#include "sim/fixed/contact_finder.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace carom {

namespace {

struct Finder {
    OdeWorld& world;
    const PairTable& pairs;
    std::vector<Contact>& found;
};

/// Where the bodies touch. Forces act at the full radius: the arm of a ball that has sunk in by
/// v dt would otherwise be shorter, and rolling would not be v = R w.
void set_geometry(Contact& contact, const dContactGeom& geom, const Vec3& center,
                  const GeomTag& ball, const GeomTag& other) {
    contact.normal = from_ode(geom.normal);
    // The geoms are larger than the balls by kTouch.
    contact.depth = geom.depth - kTouch * (ball.radius + other.radius);
    contact.arm = -ball.radius * contact.normal;
    contact.arm_other = other.radius * contact.normal;
    const double inside = other.self.is_surface ? contact.depth : 0.5 * contact.depth;
    contact.point = center - (ball.radius - inside) * contact.normal;
}

/// The paper's section 7: x and v of both virtual bodies are read from the geoms, T and eps
/// computed, and eps becomes the contact's bounce.
void near_callback(void* data, dGeomID first, dGeomID second) {
    Finder& finder = *static_cast<Finder*>(data);
    const GeomTag* ball = static_cast<const GeomTag*>(dGeomGetData(first));
    const GeomTag* other = static_cast<const GeomTag*>(dGeomGetData(second));
    // The ball before the surface; of two balls, the one that the scene names first.
    const bool swap =
        ball->self.is_surface || (!other->self.is_surface && other->self.index < ball->self.index);
    if (swap) {
        std::swap(first, second);
        std::swap(ball, other);
    }
    dContactGeom geom;
    if (dCollide(first, second, 1, &geom, sizeof geom) == 0) return;

    Contact contact;
    contact.ball = ball->self.index;
    contact.other = other->self;
    set_geometry(contact, geom, finder.world.position(contact.ball), *ball, *other);
    const PairProperties pair =
        finder.pairs.at(ball->material, ball->virtual_body, other->material, other->virtual_body);
    contact.restitution = pair.restitution;
    contact.friction = pair.friction;
    contact.laws = pair.laws;
    finder.found.push_back(contact);
}

}  // namespace

void find_contacts(OdeWorld& world, const PairTable& pairs, std::vector<Contact>& found) {
    found.clear();
    Finder finder{world, pairs, found};
    world.collide(&finder, &near_callback);
    std::sort(found.begin(), found.end(), [](const Contact& a, const Contact& b) {
        return std::tuple(a.ball, !a.other.is_surface, a.other.index) <
               std::tuple(b.ball, !b.other.is_surface, b.other.index);
    });
}

}  // namespace carom
