// A gas of hard spheres that lose nothing, in a box: what an impact costs in CPU time and memory,
// and what becomes of the energy.
//
// usage: gas [--stream] [--runs R] [BALLS PACKING IMPACTS]...
//
// BALLS of radius 0.5 m start on a lattice with random velocities and fill PACKING of a cube, for
// about IMPACTS impacts each. Each row is made by processes of its own, the best of R of them;
// memory is their peak, and what it grows by beyond a run without impacts, for each impact.
// --stream lets pieces and events go as they come to be, as films and MOTION.csv do.
#include <fmt/core.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "clock.h"
#include "gas_scene.h"
#include "sim/simulate.h"

namespace {

using namespace carom;

struct Row {
    int balls = 0;
    double packing = 0;
    double impacts = 0;  ///< a ball, about
};

/// What a child tells.
struct Measured {
    double seconds = 0;  ///< CPU
    double impacts = 0;
    double energy = 0;  ///< change, relative
    double memory = 0;  ///< bytes, peak of the process
    bool ok = false;
};

double energy_of(const std::vector<Vec3>& velocities) {
    double sum = 0;
    for (const Vec3& v : velocities) sum += v.squaredNorm();
    return sum;
}

double peak_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

Measured measure(const Row& row, bool stream) {
    Scene scene = bench::gas(row.balls, row.packing, 1, 1);
    scene.simulation.duration = row.impacts * bench::seconds_between(row.packing);
    std::vector<Vec3> before, after(scene.balls.size());
    for (const Ball& b : scene.balls) before.push_back(b.velocity);
    Measured m;
    const double start = bench::cpu_seconds();
    if (stream) {
        const SimulationResult result = simulate_piecewise(
            scene, {}, [&](MotionLog& pieces, std::vector<Event>& events, double) {
                std::vector<Trajectory> some(scene.balls.size());
                pieces.move_into(some);
                for (std::size_t i = 0; i < some.size(); ++i)
                    if (!some[i].pieces().empty()) after[i] = some[i].pieces().back().velocity;
                events.clear();
            });
        m.impacts = static_cast<double>(result.report.impacts);
    } else {
        const SimulationResult result = simulate(scene);
        m.impacts = static_cast<double>(result.report.impacts);
        for (std::size_t i = 0; i < after.size(); ++i)
            after[i] = result.motion.balls[i].pieces().back().velocity;
    }
    m.seconds = bench::cpu_seconds() - start;
    m.energy = energy_of(after) / energy_of(before) - 1;
    m.memory = peak_bytes();
    m.ok = true;
    return m;
}

/// In a process of its own, so that its peak of memory is its own too.
Measured in_child(const Row& row, bool stream) {
    void* page =
        mmap(nullptr, sizeof(Measured), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (page == MAP_FAILED) return {};
    auto* told = new (page) Measured;
    const pid_t child = fork();
    if (child == 0) {
        *told = measure(row, stream);
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    const Measured m = *told;
    munmap(page, sizeof(Measured));
    return m;
}

int run(const std::vector<Row>& rows, bool stream, int runs) {
    fmt::print(
        "  balls  packing    impacts  a ball   us an impact      MB   bytes an impact   energy\n");
    for (const Row& row : rows) {
        const Measured still = in_child({row.balls, row.packing, 0}, stream);
        Measured best = in_child(row, stream);
        for (int i = 1; i < runs; ++i) {
            const Measured m = in_child(row, stream);
            if (m.seconds < best.seconds) best = m;
        }
        if (!best.ok || !still.ok) {
            fmt::print(stderr, "gas: the run of {} balls failed\n", row.balls);
            return 1;
        }
        fmt::print("{:7} {:8.3g} {:10.0f} {:7.0f} {:14.2f} {:7.0f} {:17.0f} {:+8.0e}\n", row.balls,
                   row.packing, best.impacts, 2 * best.impacts / row.balls,
                   1e6 * (best.seconds - still.seconds) / best.impacts, best.memory / 1e6,
                   (best.memory - still.memory) / best.impacts, best.energy);
        std::fflush(stdout);
    }
    return 0;
}

}  // namespace

int main(int count, char** arguments) {
    std::vector<Row> rows;
    bool stream = false;
    int runs = 3;
    std::vector<double> numbers;
    for (int i = 1; i < count; ++i) {
        const std::string_view argument = arguments[i];
        if (argument == "--stream")
            stream = true;
        else if (argument == "--runs" && i + 1 < count)
            runs = std::max(std::atoi(arguments[++i]), 1);
        else
            numbers.push_back(std::atof(arguments[i]));
    }
    if (numbers.size() % 3 != 0) {
        fmt::print(stderr, "usage: gas [--stream] [--runs R] [BALLS PACKING IMPACTS]...\n");
        return 2;
    }
    for (std::size_t i = 0; i < numbers.size(); i += 3)
        rows.push_back({static_cast<int>(numbers[i]), numbers[i + 1], numbers[i + 2]});
    if (rows.empty())
        for (const Row row : {Row{1000, 0.065, 288}, Row{10'000, 0.065, 73}, Row{1000, 0.3, 522},
                              Row{10'000, 0.3, 228}, Row{10'000, 0.45, 206}})
            rows.push_back(row);
    return run(rows, stream, runs);
}
