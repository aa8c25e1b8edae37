// Coefficients of restitution from virtual bodies, and what two materials do to each other.
//
// Khurelbaatar, Enkhzul, Amartuvshin, Sukhbat, "The Graphical Method for Decision of Restitution
// Coefficient and Its Applications", Journal of Software Engineering and Applications 5(6), 2012,
// Eq. 6, 7 and 10: inside each body lies a virtual one, whose surface is a distance x below the
// real surface and moves towards the contact at the speed v.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "scene/scene.h"

namespace carom {

/// One body's part of Eq. 6: x / (2 v) in seconds. 0 for x = 0, whatever v is: such a body loses
/// nothing. Infinity for x = infinity: such a body never rebounds. It is also T of Eq. 10, the
/// contact with a body that is taken as rigid.
double virtual_time(const VirtualBody& body);

/// Eq. 6: T = x_A / (2 v_A) + x_B / (2 v_B), in seconds.
double contact_time(const VirtualBody& a, const VirtualBody& b);

/// Eq. 7: eps = exp(-K T), `constant` K in 1/s. T = infinity gives 0.
double restitution_of_time(double time, double constant);

/// What a contact of two materials does.
struct PairProperties {
    double restitution = 1;  ///< Newton's, 0 ... 1
    double friction = 0;     ///< Coulomb's mu, 0: no friction is modelled
};

/// The pair rules of a scene: restitution eps_A eps_B (Eq. 6 and 7 say this product), friction
/// mu_A mu_B, and `pairs`, which override either. A material without friction counts as mu = 0.
class PairTable {
  public:
    explicit PairTable(const Scene& scene);

    /// Of two materials, by their indices in the scene; the order does not matter.
    PairProperties at(int material_a, int material_b) const;

    /// The same for virtual bodies at hand (`fixed` reads them from the geoms, as the paper does).
    PairProperties at(int material_a, const VirtualBody& a, int material_b,
                      const VirtualBody& b) const;

    /// Whether two things of the scene that can meet (ball and surface, ball and ball) have
    /// friction.
    bool any_friction() const { return any_friction_; }

  private:
    struct Override {
        std::optional<double> restitution;
        std::optional<double> friction;
    };
    bool scene_has_friction(const Scene& scene) const;

    double constant_;
    std::vector<VirtualBody> bodies_;
    std::vector<double> friction_;
    std::map<std::array<int, 2>, Override> overrides_;  ///< lower index first
    bool any_friction_;
};

}  // namespace carom
