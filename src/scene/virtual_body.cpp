#include "scene/virtual_body.h"

#include <cmath>
#include <limits>

namespace carom {

double rigid_restitution(const VirtualBody& body, double restitution_constant) {
    if (body.distance_m == 0) return 1;  // whatever the velocity, also 0
    return std::exp(-restitution_constant * body.distance_m / (2 * body.velocity_m_s));
}

VirtualBody virtual_body_for(double restitution, double restitution_constant) {
    if (restitution >= 1) return {0, 1};
    if (restitution <= 0) return {std::numeric_limits<double>::infinity(), 1};
    return {-2 * std::log(restitution) / restitution_constant, 1};
}

}  // namespace carom
