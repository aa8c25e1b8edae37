// The method `fixed`, the paper's own: one ODE world, one step size.
//
// Source: Khurelbaatar et al. 2012, section 7 (see restitution.h), with Open Dynamics Engine
// 0.16.2. It is kept as plain as the paper's, because it is what other methods are measured
// against: ODE's own integrator, its own contact solver, contacts where bodies already overlap.
// Errors are therefore of the order of the step h:
//   - free fall lags by -g t h / 2 (semi-implicit Euler), so a state at time 0 already moves at
//     v + g h / 2 (recorder.h says how step velocities and the motion's velocity are related);
//   - an impact comes up to h late, and up to v h too deep;
//   - a ball that crosses a thin surface within one step is not seen.
#pragma once

#include <stop_token>

#include "scene/scene.h"
#include "sim/record/simulation_result.h"

namespace carom {

/// Steps the scene to its duration, or until everything rests. Steps are never cut short: the last
/// one ends at the duration or beyond it, and the motion is evaluated up to the duration. With
/// duration `rest` the motion ends EventLog::kRestSteps steps after the last ball has settled, at
/// max_duration at the latest, and always there without gravity, which is what makes balls rest.
///
/// Throws Failure(kRun) as simulate() does.
SimulationResult simulate_fixed(const Scene& scene, const std::stop_token& stop,
                                const SimulationProgress& progress);

}  // namespace carom
