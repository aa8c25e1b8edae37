#include "random_laws.h"

namespace carom::bench {

namespace {

/// So steep that the product of two is allowed still.
RestitutionLaw random_law(Draw& draw) {
    const double which = draw.unit();
    if (which < 0.4)
        return PowerRestitution{draw.uniform(0.1, 1), draw.log_uniform(0.1, 10),
                                draw.uniform(-0.5, 0.45)};
    if (which < 0.7) return ViscoelasticRestitution{draw.log_uniform(0.01, 1)};
    const double slow = draw.uniform(0, 1), fast = slow + draw.uniform(2, 9);
    return MonotoneCurve({slow, 0.5 * (slow + fast), fast},
                         {draw.uniform(0.8, 1), draw.uniform(0.7, 0.9), draw.uniform(0.6, 0.8)});
}

template <class Named>
void add_laws(Named& named, Draw& draw) {
    if (draw.chance(0.5)) named.rolling = draw.chance(0.2) ? 1 : draw.log_uniform(1e-3, 1);
    if (draw.chance(0.5)) named.pivoting = draw.log_uniform(1e-5, 1e-2);
    if (draw.chance(0.5)) named.tangential_restitution = draw.uniform(-1, 1);
}

}  // namespace

void add_contact_laws(Scene& scene, Draw& draw) {
    for (std::size_t i = 1; i < scene.materials.size(); ++i) {
        Material& material = scene.materials[i];
        add_laws(material, draw);
        if (draw.chance(0.5)) continue;
        material.restitution_law = random_law(draw);
        material.virtual_body = {};
    }
    for (PairRule& rule : scene.pairs) {
        if (draw.chance(0.5)) add_laws(rule, draw);
        if (draw.chance(0.5)) continue;
        rule.restitution.reset();
        rule.restitution_law = random_law(draw);
    }
}

}  // namespace carom::bench
