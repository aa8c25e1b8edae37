#include "sim/simulate.h"

#include <utility>

#include "core/check.h"
#include "sim/fixed/fixed.h"
#include "sim/nearby_origin.h"
#include "sim/pipe_halves.h"
#include "sim/record/peaks.h"

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

std::string why_known_at_end(const Scene& scene) {
    if (scene.simulation.method == Method::kFixed)
        return "steps become pieces when it is known how far these reach (method: fixed)";
    if (!nearby_origin(scene).isZero(0)) return "the motion is computed about another origin";
    if (!with_pipe_halves(scene).whole.empty()) return "pipes are computed as halves";
    return "";
}

SimulationResult simulate_piecewise(const Scene& scene, const std::stop_token& stop,
                                    const PieceTap& tap) {
    CAROM_CHECK(why_known_at_end(scene), ==, "");
    ExactOptions options;
    options.tap = tap;
    return simulate_exact(scene, stop, {}, options);
}

void complete(const Scene& scene, std::vector<Trajectory> balls, std::vector<Event> events,
              SimulationResult& result) {
    result.motion.balls = std::move(balls);
    result.motion.events = std::move(events);
    result.motion.peaks = find_peaks(scene, result.motion);
}

SimulationResult simulate(const Scene& scene, const std::stop_token& stop,
                          const SimulationProgress& progress) {
    const HalvedScene halved = with_pipe_halves(scene);
    if (halved.whole.empty()) return simulate_near_origin(scene, stop, progress);
    SimulationResult result = simulate_near_origin(halved.scene, stop, progress);
    make_whole(result.motion, scene, halved.whole);
    return result;
}

}  // namespace carom
