// Short scenes through the C++ library, one after the other: bench/python_cost.py compares with it.
//   library_rate SCENE.yaml COUNT read|simulate
// `read` reads the text and simulates it each time, `simulate` reads it once. Prints CPU seconds.
#include <carom/carom.h>
#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string_view>

#include "clock.h"

int main(int argc, char** argv) {
    if (argc != 4) return 2;
    std::stringstream text;
    text << std::ifstream(argv[1]).rdbuf();
    const std::string yaml = text.str();
    const int count = std::atoi(argv[2]);
    const bool reads = std::string_view(argv[3]) == "read";
    const carom::Scene scene = carom::Scene::from_text(yaml);
    std::uint64_t hashes = 0;  // their sum
    const double begin = carom::bench::cpu_seconds();
    for (int i = 0; i < count; ++i)
        hashes += carom::simulate(reads ? carom::Scene::from_text(yaml) : scene).hash();
    fmt::print("{:.6f} {:016x}\n", carom::bench::cpu_seconds() - begin, hashes);
    return 0;
}
