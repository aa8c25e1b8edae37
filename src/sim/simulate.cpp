#include "sim/simulate.h"

#include "sim/exact/exact.h"
#include "sim/fixed/fixed.h"
#include "sim/nearby_origin.h"
#include "sim/pipe_halves.h"

namespace carom {

namespace {

SimulationResult simulate_here(const Scene& scene, double place_rounding,
                               const std::stop_token& stop, const SimulationProgress& progress) {
    if (scene.simulation.method == Method::kFixed) return simulate_fixed(scene, stop, progress);
    ExactOptions options;
    options.place_rounding = place_rounding;
    return simulate_exact(scene, stop, progress, options);
}

SimulationResult simulate_near_origin(const Scene& scene, const std::stop_token& stop,
                                      const SimulationProgress& progress) {
    const Vec3 origin = nearby_origin(scene);
    if (origin.isZero(0)) return simulate_here(scene, 0, stop, progress);
    SimulationResult result =
        simulate_here(seen_from(scene, origin), place_rounding(origin), stop, progress);
    move_back(result.motion, origin);
    return result;
}

}  // namespace

SimulationResult simulate(const Scene& scene, const std::stop_token& stop,
                          const SimulationProgress& progress) {
    const HalvedScene halved = with_pipe_halves(scene);
    if (halved.whole.empty()) return simulate_near_origin(scene, stop, progress);
    SimulationResult result = simulate_near_origin(halved.scene, stop, progress);
    make_whole(result.motion, scene, halved.whole);
    return result;
}

}  // namespace carom
