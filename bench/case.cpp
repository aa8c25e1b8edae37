#include "case.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace carom::bench {

double Measure::error() const {
    if (!std::isfinite(value)) return std::numeric_limits<double>::infinity();
    return std::abs(value - reference) / scale;
}

Measure relative(std::string what, double value, double reference, double limit) {
    return scaled(std::move(what), value, reference, std::abs(reference), limit);
}

Measure scaled(std::string what, double value, double reference, double scale, double limit) {
    return {std::move(what), value, reference, scale, limit, ""};
}

Measure vector_measure(std::string what, const Vec3& value, const Vec3& reference, double scale,
                       double limit) {
    return {std::move(what), (value - reference).norm(), 0, scale, limit, ""};
}

Override set(const std::string& path, double value) { return {path, fmt::format("{}", value)}; }

Override set(const std::string& path, const Vec3& value) {
    return {path, fmt::format("[{}, {}, {}]", value.x(), value.y(), value.z())};
}

std::vector<Case> all_cases() {
    std::vector<Case> all;
    for (const auto part : {bounce_cases, impact_cases, chain_cases, friction_cases, contact_cases,
                            seam_cases, surface_cases}) {
        std::vector<Case> some = part();
        std::move(some.begin(), some.end(), std::back_inserter(all));
    }
    const auto number = [](const Case& c) { return std::stoi(c.id.substr(1)); };
    std::stable_sort(all.begin(), all.end(),
                     [&](const Case& a, const Case& b) { return number(a) < number(b); });
    return all;
}

}  // namespace carom::bench
