// Open Dynamics Engine as its manual has it: collide, a contact joint per contact, one step;
// nothing of carom's. What SimBenchmark did, too: with ERP 0 and CFM 0 it gives their published
// errors.
#pragma once

#include <memory>

#include "scene/scene.h"
#include "stepped_world.h"

namespace carom::bench {

enum class OdeStepper { kWorld, kQuick };  ///< dWorldStep, dWorldQuickStep (20 iterations)

/// Semi-implicit Euler with steps of `step` seconds; contacts with dContactBounce, the pair's
/// coefficient, a bounce velocity of 0 and no friction; a sweep-and-prune space, which is the
/// fastest of ODE's spaces here. Balls and planes only. ODE's messages are dropped: a step that its
/// solver could not do shows in the motion.
std::unique_ptr<SteppedWorld> make_plain_ode(const Scene& scene, double step, OdeStepper stepper);

}  // namespace carom::bench
