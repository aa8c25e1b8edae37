#include "engine.h"

#include <fmt/core.h>

#include "sim/versions.h"
#ifdef CAROM_BENCH_BULLET
#include "bullet_world.h"
#endif

namespace carom::bench {

namespace {

std::string step_name(double step) { return fmt::format("{:g} ms", 1e3 * step); }

Engine exact_engine() {
    return {"exact", "exact", 0, [](const Scene& scene, const SimulationProgress& progress) {
                Scene own = scene;
                own.simulation.method = Method::kExact;
                return simulate(own, {}, progress);
            }};
}

Engine ode_engine(Solver solver, double step) {
    const std::string family = solver == Solver::kQuick ? "ODE quick" : "ODE world";
    return {family + ' ' + step_name(step), family, step,
            [solver, step](const Scene& scene, const SimulationProgress& progress) {
                Scene own = scene;
                own.simulation.method = Method::kFixed;
                own.simulation.solver = solver;
                own.simulation.step = step;
                return simulate(own, {}, progress);
            }};
}

#ifdef CAROM_BENCH_BULLET
Engine bullet_engine(double step) {
    return {"Bullet " + step_name(step), "Bullet", step,
            [step](const Scene& scene, const SimulationProgress& progress) {
                return simulate_bullet(scene, step, progress);
            }};
}
#endif

}  // namespace

std::vector<Engine> all_engines() {
    std::vector<Engine> engines = {exact_engine()};
    for (const Solver solver : {Solver::kWorld, Solver::kQuick})
        for (const double step : {1e-3, 1e-4}) engines.push_back(ode_engine(solver, step));
#ifdef CAROM_BENCH_BULLET
    for (const double step : {1e-3, 1e-4}) engines.push_back(bullet_engine(step));
#endif
    return engines;
}

std::string engine_versions() {
    std::string text = fmt::format("carom {}", CAROM_VERSION);
    for (const auto& [name, version] : simulation_versions())
        text += fmt::format(", {} {} (double)", name, version);
#ifdef CAROM_BENCH_BULLET
    return text + ", " + bullet_version();
#else
    return text + ", built without Bullet (libbullet-dev was not there)";
#endif
}

}  // namespace carom::bench
