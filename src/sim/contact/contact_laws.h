// What two materials do to each other beyond a constant coefficient and Coulomb's friction.
#pragma once

#include <algorithm>

#include "scene/restitution_law.h"
#include "sim/contact/contact.h"

namespace carom {

/// Of a pair that has any of it; contacts of other pairs have none (Touch::laws).
struct ContactLaws {
    /// Newton's coefficient is `constant` times these at the approach speed. They belong to the
    /// scene; null for none.
    const RestitutionLaw* first = nullptr;
    const RestitutionLaw* second = nullptr;
    double constant = 1;
    /// After an impact that grips, the slip is minus this times that before.
    double tangential_restitution = 0;
    /// A ball that rolls slows by this times N/m; 0 where there is no friction to roll by.
    double rolling = 0;
    /// Moment against spin about the normal, over the normal force, m.
    double pivoting = 0;

    bool by_speed() const { return first != nullptr; }
    /// The coefficient at an approach speed [m/s] >= 0; at 0 its limit.
    double restitution_at(double speed) const {
        double e = constant;
        if (first != nullptr) e *= carom::restitution_at(*first, speed);
        if (second != nullptr) e *= carom::restitution_at(*second, speed);
        return e;
    }
    /// Whether slow impacts lose nothing by its law, so that bounces have no end.
    bool is_endless() const { return by_speed() && !(restitution_at(0) < 1); }
    bool resists() const { return rolling > 0 || pivoting > 0; }
    bool is_plain() const { return !by_speed() && tangential_restitution == 0 && !resists(); }
};

/// The coefficient of this impact, whose approach speed is known.
inline void find_restitution(Touch& contact) {
    if (contact.laws != nullptr && contact.laws->by_speed())
        contact.restitution = contact.laws->restitution_at(std::max(contact.approach_speed, 0.0));
}

inline double tangential_restitution(const Touch& contact) {
    return contact.laws == nullptr ? 0 : contact.laws->tangential_restitution;
}

/// Whether rolling or spin about the normal is resisted.
inline bool is_resisted(const Touch& contact) {
    return contact.laws != nullptr && contact.laws->resists();
}

}  // namespace carom
