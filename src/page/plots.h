// Plots of a page as SVG: whose cursor the viewer moves, in the colours of the page's style.
#pragma once

#include <string>

#include "motion/motion.h"
#include "scene/scene.h"

namespace carom {

/// Height of each ball's lowest point [m] against time, upwards being against gravity: parabolas
/// are drawn as such. Of many balls the first kMostCurves. With a list of its curves.
std::string height_plot(const Scene& scene, const Motion& motion);
inline constexpr std::size_t kMostCurves = 14;

/// Kinetic energy (with spin), potential energy over a height of 0, and their sum, J, of all balls.
std::string energy_plot(const Scene& scene, const Motion& motion);

}  // namespace carom
