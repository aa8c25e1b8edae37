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
#include <set>
#include <vector>

#include "scene/scene.h"
#include "sim/contact/contact_laws.h"

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
    double restitution = 1;  ///< Newton's, 0 ... 1; of slow impacts where it depends on the speed
    double friction = 0;     ///< Coulomb's mu, 0: no friction is modelled
    /// What else there is; null for nothing. Lives as long as the table and the scene.
    const ContactLaws* laws = nullptr;
};

/// The pair rules of a scene: restitution eps_A eps_B (Eq. 6 and 7 say this product), friction
/// mu_A mu_B, rolling resistance likewise, pivoting the sum, tangential restitution the product of
/// those that are named; and `pairs`, which override each. What a material does not name counts as
/// 0. The scene must outlive the table. One table serves one run: asking may note a pair's laws.
class PairTable {
  public:
    explicit PairTable(const Scene& scene);
    PairTable(const PairTable&) = delete;
    PairTable& operator=(const PairTable&) = delete;

    /// Of two materials, by their indices in the scene; the order does not matter.
    PairProperties at(int material_a, int material_b) const;

    /// The same for virtual bodies at hand (`fixed` reads them from the geoms, as the paper does).
    PairProperties at(int material_a, const VirtualBody& a, int material_b,
                      const VirtualBody& b) const;

    /// Whether two things of the scene that can meet (ball and surface, ball and ball) have
    /// friction.
    bool any_friction() const { return any_friction_; }
    /// Whether two things that can meet lose energy in an impact, friction aside.
    bool any_loss() const;
    /// Whether two things that can meet have laws for which `has` holds.
    bool any(bool (*has)(const ContactLaws&)) const;

  private:
    bool may_meet(int material_a, int material_b) const;
    bool find_friction() const;
    double product(std::optional<double> Material::*factor, int a, int b) const;
    const ContactLaws* laws_of(int a, int b, const PairProperties& pair,
                               const PairRule* rule) const;

    double constant_;
    const std::vector<Material>& materials_;
    std::map<std::array<int, 2>, PairRule> overrides_;  ///< lower index first
    std::map<int, int> balls_of_;                       ///< by material, how many
    std::set<int> of_surfaces_;
    bool any_laws_ = false;  ///< a material or a rule names what makes some
    bool any_friction_;
    mutable std::map<std::array<int, 2>, ContactLaws> laws_;  ///< as far as asked for
};

}  // namespace carom
