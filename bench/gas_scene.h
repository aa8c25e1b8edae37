// Gases of equal balls in a cube, and what theory says of them.
#pragma once

#include "scene/scene.h"

namespace carom::bench {

/// Balls of radius 0.5 m and mass 1 kg on a lattice that fills `packing` of a cube of six planes,
/// with velocities of variance 1 m^2/s^2 along each axis, no friction and no gravity. Walls lose
/// nothing, two balls keep `restitution` of their approach speed.
Scene gas(int balls, double packing, double restitution, unsigned seed);
/// m, of the cube.
double side_of(int balls, double packing);

/// p V / (N k T) of a fluid of hard spheres (N. F. Carnahan, K. E. Starling, "Equation of state for
/// nonattracting rigid spheres", J. Chem. Phys. 51, 1969).
double compressibility(double packing);
/// Between a ball's impacts as the same equation has it (Enskog's theory): its mean free path [m],
/// and the time [s] at a speed of variance 1 along each axis.
double free_path(double packing);
double seconds_between(double packing);

}  // namespace carom::bench
