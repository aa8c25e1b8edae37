#include "scene/frame_rate.h"

#include <charconv>
#include <cmath>
#include <numeric>

#include "scene/scalar.h"

namespace carom {

FrameRate frame_rate(double value) {
    constexpr double kSameValue = 1e-12;  // relative; finer than anyone writes a frame rate
    constexpr double kLargest = 1e9;      // fits an int
    double h0 = 0, h1 = 1, k0 = 1, k1 = 0, rest = value;
    for (int i = 0; i < 40; ++i) {
        const double whole = std::floor(rest);
        const double h2 = whole * h1 + h0, k2 = whole * k1 + k0;
        if (h2 > kLargest || k2 > kLargest) break;
        h0 = h1, h1 = h2, k0 = k1, k1 = k2;
        if (std::abs(h1 / k1 - value) <= kSameValue * value || rest == whole) break;
        rest = 1 / (rest - whole);
    }
    return {static_cast<int>(h1), static_cast<int>(k1)};
}

namespace {

/// Digits alone, above 0, that fit an int.
std::optional<int> whole(const std::string& text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value <= 0) return std::nullopt;
    return value;
}

}  // namespace

std::optional<FrameRate> parse_rate(const std::string& text, double most) {
    std::optional<FrameRate> rate;
    if (const std::size_t slash = text.find('/'); slash != std::string::npos) {
        const std::optional<int> up = whole(text.substr(0, slash)),
                                 down = whole(text.substr(slash + 1));
        if (!up || !down) return std::nullopt;
        const int common = std::gcd(*up, *down);
        rate = FrameRate{*up / common, *down / common};
    } else {
        const Scalar number = resolve_scalar(text, false);
        // Slower than one in thirty years, no fraction of ints is the rate any more.
        constexpr double kLeast = 1e-9;
        if (number.kind != Scalar::Kind::kNumber || !(number.number >= kLeast)) return std::nullopt;
        if (number.number > most) return std::nullopt;
        rate = frame_rate(number.number);
    }
    if (rate->numerator <= 0 || rate->per_second() > most) return std::nullopt;
    return rate;
}

}  // namespace carom
