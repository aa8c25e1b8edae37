// What random materials do beyond two numbers.
#pragma once

#include "draw.h"
#include "scene/scene.h"

namespace carom::bench {

/// Gives the materials of a scene, and its pairs, coefficients over the approach speed, rolling
/// resistance, pivoting and tangential restitution, each with some chance.
void add_contact_laws(Scene& scene, Draw& draw);

}  // namespace carom::bench
