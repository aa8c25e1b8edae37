#include "scene/restitution_law.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace carom {

namespace {

/// gamma v^(1/5) at the lowest point of the viscoelastic coefficient: -1 + 6/5 x = 0.
constexpr double kLowestViscoelastic = 5.0 / 6;

/// A fall of the separation speed by this part of a change of the approach is rounding.
constexpr double kLeastFall = 1e-12;

/// Points that are looked at between two places where a law changes its form, and over all speeds:
/// so many a decade from ... to ... m/s. Tables of very many entries are looked at in fewer points
/// between two of them, but always in the middle.
constexpr int kPointsBetween = 64;
constexpr std::size_t kMostPoints = 100'000;
constexpr int kPointsOfDecade = 16;
constexpr double kSlowest = 1e-9, kFastest = 1e9;

/// The coefficient and its derivative by the speed [s/m].
struct Restitution {
    double value = 1, slope = 0;
};

Restitution look(const MonotoneCurve& curve, double v) { return {curve.at(v), curve.slope_at(v)}; }

Restitution look(const PowerRestitution& power, double v) {
    const double e = power.value * std::pow(v / power.at_speed, -power.exponent);
    if (!(e < 1)) return {};
    return {e, v > 0 ? -power.exponent * e / v : 0};
}

Restitution look(const ViscoelasticRestitution& law, double v) {
    const double x = std::min(law.gamma * std::pow(v, 0.2), kLowestViscoelastic);
    const double slope = v > 0 && x < kLowestViscoelastic ? (-0.2 * x + 0.24 * x * x) / v : 0.0;
    return {1 - x + 0.6 * x * x, slope};
}

Restitution look(const RestitutionLaw& law, double v) {
    return std::visit([v](const auto& l) { return look(l, v); }, law);
}

/// Where a law changes its form.
void add_places(const MonotoneCurve& curve, std::vector<double>& places) {
    places.insert(places.end(), curve.x().begin(), curve.x().end());
}
void add_places(const PowerRestitution& power, std::vector<double>& places) {
    if (power.exponent == 0) return;
    places.push_back(power.at_speed * std::pow(power.value, 1 / power.exponent));
}
void add_places(const ViscoelasticRestitution& law, std::vector<double>& places) {
    if (law.gamma > 0) places.push_back(std::pow(kLowestViscoelastic / law.gamma, 5));
}

/// The speeds at which the separation is looked at, ascending.
std::vector<double> speeds_of(const RestitutionLaw& law, const RestitutionLaw* other) {
    std::vector<double> places = {0};
    const auto add = [&places](const auto& l) { add_places(l, places); };
    std::visit(add, law);
    if (other != nullptr) std::visit(add, *other);
    std::erase_if(places, [](double v) { return !(v >= 0) || !(v <= kFastest); });
    std::sort(places.begin(), places.end());
    std::vector<double> speeds = places;
    const int parts = std::clamp(static_cast<int>(kMostPoints / places.size()), 2, kPointsBetween);
    for (std::size_t i = 0; i + 1 < places.size(); ++i)
        for (int k = 1; k < parts; ++k)
            speeds.push_back(places[i] + (places[i + 1] - places[i]) * k / parts);
    const double ratio = std::pow(10.0, 1.0 / kPointsOfDecade);
    for (double v = kSlowest; v <= kFastest; v *= ratio) speeds.push_back(v);
    std::sort(speeds.begin(), speeds.end());
    return speeds;
}

/// e v of both laws together [m/s], and its derivative.
Restitution separation(const RestitutionLaw& law, const RestitutionLaw* other, double v) {
    const Restitution a = look(law, v), b = other == nullptr ? Restitution{} : look(*other, v);
    return {a.value * b.value * v, a.value * b.value + v * (a.slope * b.value + a.value * b.slope)};
}

}  // namespace

double restitution_at(const RestitutionLaw& law, double speed) { return look(law, speed).value; }

std::optional<FallingSeparation> falling_separation(const RestitutionLaw& law,
                                                    const RestitutionLaw* other) {
    const std::vector<double> speeds = speeds_of(law, other);
    std::optional<FallingSeparation> found;
    for (std::size_t i = 0; i < speeds.size(); ++i) {
        const Restitution at = separation(law, other, speeds[i]);
        const Restitution before = separation(law, other, speeds[i > 0 ? i - 1 : 0]);
        const double way = i > 0 ? speeds[i] - speeds[i - 1] : 0;
        const bool falls = at.slope < -kLeastFall || at.value < before.value - kLeastFall * way;
        if (falls && !found) {
            const bool since = at.value < before.value;
            found = {since ? speeds[i - 1] : speeds[i], speeds[i], since ? before.value : at.value,
                     at.value};
        } else if (falls) {
            found->to = speeds[i];
            found->separation_to = at.value;
        } else if (found) {
            break;
        }
    }
    return found;
}

}  // namespace carom
