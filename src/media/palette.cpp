#include "media/palette.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "media/straight_alpha.h"

namespace carom {

namespace {

constexpr int kMostColours = 255;
constexpr int kBinBits = 5;
constexpr std::size_t kBins = std::size_t{1} << (3 * kBinBits);
constexpr int kOpaque = 128;  // alpha from here on is seen
constexpr int kKnownBits = 16;

/// When a palette is given up: a mean square of this many times what it was made with, and a step
/// of 2 of 255 more.
constexpr double kWorse = 2, kWorseBy = 4;

constexpr std::size_t bin_of(unsigned b, unsigned g, unsigned r) {
    constexpr int kDrop = 8 - kBinBits;
    return (b >> kDrop) | (g >> kDrop) << kBinBits | (r >> kDrop) << (2 * kBinBits);
}

/// Straight colour of a pixel, 0xRRGGBB.
std::uint32_t colour_of(const std::uint8_t* p) {
    const unsigned a = p[3];
    if (a == 255)
        return p[0] | static_cast<std::uint32_t>(p[1]) << 8 |
               static_cast<std::uint32_t>(p[2]) << 16;
    return straighten(p[0], a) | static_cast<std::uint32_t>(straighten(p[1], a)) << 8 |
           static_cast<std::uint32_t>(straighten(p[2], a)) << 16;
}

/// Shades first ... last - 1 with their mean and the variance along their widest channel.
template <class Shade>
struct Box {
    std::size_t first = 0, last = 0;
    double mean[3] = {}, weight = 0;
    int widest = 0;
    double spread = 0;  ///< weight times variance

    Box(const std::vector<Shade>& shades, std::size_t begin, std::size_t end)
        : first(begin), last(end) {
        double square[3] = {};
        for (std::size_t i = first; i < last; ++i) {
            const double channels[3] = {shades[i].b, shades[i].g, shades[i].r};
            weight += shades[i].weight;
            for (int c = 0; c < 3; ++c) {
                mean[c] += shades[i].weight * channels[c];
                square[c] += shades[i].weight * channels[c] * channels[c];
            }
        }
        for (int c = 0; c < 3; ++c) {
            mean[c] /= weight;
            const double here = square[c] - weight * mean[c] * mean[c];
            if (c == 0 || here > spread) spread = here, widest = c;
        }
        if (last - first < 2) spread = 0;
    }
};

}  // namespace

FilmPalette::FilmPalette() : bins_(kBins), known_(std::size_t{1} << kKnownBits) {}

std::vector<FilmPalette::Shade> FilmPalette::count(const Image& image) {
    std::vector<Bin> here(kBins);
    for (std::size_t i = 0; i < image.bgra.size(); i += 4) {
        if (image.bgra[i + 3] < kOpaque) continue;
        const std::uint32_t colour = colour_of(&image.bgra[i]);
        const unsigned b = colour & 255, g = colour >> 8 & 255, r = colour >> 16;
        Bin& bin = here[bin_of(b, g, r)];
        ++bin.pixels;
        bin.b += b, bin.g += g, bin.r += r;
    }
    std::vector<Shade> shades;
    for (std::size_t i = 0; i < kBins; ++i) {
        const Bin& bin = here[i];
        if (bin.pixels == 0) continue;
        const auto n = static_cast<double>(bin.pixels);
        shades.push_back({static_cast<double>(bin.b) / n, static_cast<double>(bin.g) / n,
                          static_cast<double>(bin.r) / n, std::sqrt(n)});
        bins_[i].pixels += bin.pixels;
        bins_[i].b += bin.b, bins_[i].g += bin.g, bins_[i].r += bin.r;
    }
    return shades;
}

std::vector<FilmPalette::Shade> FilmPalette::all_shades() const {
    std::vector<Shade> shades;
    for (const Bin& bin : bins_) {
        if (bin.pixels == 0) continue;
        const auto n = static_cast<double>(bin.pixels);
        shades.push_back({static_cast<double>(bin.b) / n, static_cast<double>(bin.g) / n,
                          static_cast<double>(bin.r) / n, std::sqrt(n)});
    }
    return shades;
}

int FilmPalette::nearest(int b, int g, int r) const {
    int best = 0, least = std::numeric_limits<int>::max();
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
        const int db = chosen_[i].b - b, dg = chosen_[i].g - g, dr = chosen_[i].r - r;
        const int distance = db * db + dg * dg + dr * dr;
        if (distance < least) least = distance, best = static_cast<int>(i);
    }
    return best;
}

double FilmPalette::error_of(const std::vector<Shade>& shades) const {
    double sum = 0, weight = 0;
    for (const Shade& s : shades) {
        const Colour& c = chosen_[static_cast<std::size_t>(
            nearest(static_cast<int>(std::lround(s.b)), static_cast<int>(std::lround(s.g)),
                    static_cast<int>(std::lround(s.r))))];
        sum += s.weight *
               ((s.b - c.b) * (s.b - c.b) + (s.g - c.g) * (s.g - c.g) + (s.r - c.r) * (s.r - c.r));
        weight += s.weight;
    }
    return weight > 0 ? sum / weight : 0;
}

void FilmPalette::choose(const std::vector<Shade>& all) {
    std::vector<Shade> shades = all;
    std::vector<Box<Shade>> boxes = {Box<Shade>(shades, 0, shades.size())};
    while (boxes.size() < kMostColours) {
        const auto widest =
            std::max_element(boxes.begin(), boxes.end(),
                             [](const auto& a, const auto& b) { return a.spread < b.spread; });
        if (widest->spread <= 0) break;
        const int channel = widest->widest;
        const double middle = widest->mean[channel];
        const auto begin = shades.begin() + static_cast<std::ptrdiff_t>(widest->first);
        const auto end = shades.begin() + static_cast<std::ptrdiff_t>(widest->last);
        const auto cut = std::stable_partition(begin, end, [&](const Shade& s) {
            return (channel == 0 ? s.b : channel == 1 ? s.g : s.r) < middle;
        });
        if (cut == begin || cut == end) {  // equal but for rounding
            widest->spread = 0;
            continue;
        }
        const std::size_t first = widest->first, last = widest->last;
        const std::size_t between = first + static_cast<std::size_t>(cut - begin);
        *widest = Box<Shade>(shades, first, between);
        boxes.emplace_back(shades, between, last);
    }
    chosen_.clear();
    const auto byte = [](double x) { return static_cast<int>(std::lround(x)); };
    for (const auto& box : boxes)
        chosen_.push_back({byte(box.mean[0]), byte(box.mean[1]), byte(box.mean[2])});
    constexpr int kRounds = 4;
    for (int i = 0; i < kRounds; ++i) move_to_means(shades);
    std::fill(known_.begin(), known_.end(), Known{});
}

/// One round of k-means: each colour goes to the mean of the shades that are nearest to it.
void FilmPalette::move_to_means(const std::vector<Shade>& shades) {
    std::vector<Shade> sums(chosen_.size(), Shade{0, 0, 0, 0});
    for (const Shade& s : shades) {
        Shade& sum = sums[static_cast<std::size_t>(nearest(static_cast<int>(std::lround(s.b)),
                                                           static_cast<int>(std::lround(s.g)),
                                                           static_cast<int>(std::lround(s.r))))];
        sum.b += s.weight * s.b, sum.g += s.weight * s.g, sum.r += s.weight * s.r;
        sum.weight += s.weight;
    }
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
        if (sums[i].weight <= 0) continue;
        const auto mean = [&](double x) {
            return static_cast<int>(std::lround(x / sums[i].weight));
        };
        chosen_[i] = {mean(sums[i].b), mean(sums[i].g), mean(sums[i].r)};
    }
}

FilmPalette::Pattern FilmPalette::make_pattern(std::uint32_t colour) const {
    const int wanted[3] = {static_cast<int>(colour & 255), static_cast<int>(colour >> 8 & 255),
                           static_cast<int>(colour >> 16 & 255)};
    int missing[3] = {0, 0, 0};  // what the entries so far owe to the colour
    Pattern pattern{};
    for (std::uint8_t& entry : pattern) {
        entry = static_cast<std::uint8_t>(
            nearest(wanted[0] + missing[0], wanted[1] + missing[1], wanted[2] + missing[2]));
        const Colour& c = chosen_[entry];
        missing[0] += wanted[0] - c.b;
        missing[1] += wanted[1] - c.g;
        missing[2] += wanted[2] - c.r;
    }
    const auto luma = [&](std::uint8_t i) {
        return 2126 * chosen_[i].r + 7152 * chosen_[i].g + 722 * chosen_[i].b;
    };
    std::stable_sort(pattern.begin(), pattern.end(),
                     [&](std::uint8_t a, std::uint8_t b) { return luma(a) < luma(b); });
    return pattern;
}

const FilmPalette::Pattern& FilmPalette::pattern_of(std::uint32_t colour) {
    // Fibonacci hashing: neighbouring colours get places far apart.
    Known& known = known_[static_cast<std::uint32_t>(colour * 2654435769U) >> (32 - kKnownBits)];
    if (!known.valid || known.colour != colour) known = {colour, true, make_pattern(colour)};
    return known.pattern;
}

void FilmPalette::convert(const Image& image, std::uint8_t* indices, std::ptrdiff_t stride,
                          std::array<std::uint32_t, 256>& colours) {
    const std::vector<Shade> shades = count(image);
    if (!shades.empty() && (chosen_.empty() || error_of(shades) > kWorse * error_ + kWorseBy)) {
        const std::vector<Shade> all = all_shades();
        choose(all);
        error_ = error_of(all);
    }
    constexpr int kBayer[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
    for (int y = 0; y < image.height_px; ++y) {
        const std::uint8_t* p = image.row(y);
        std::uint8_t* out = indices + y * stride;
        for (int x = 0; x < image.width_px; ++x, p += 4)
            out[x] = p[3] < kOpaque
                         ? static_cast<std::uint8_t>(kTransparent)
                         : pattern_of(colour_of(p))[static_cast<std::size_t>(kBayer[y % 4][x % 4])];
    }
    colours.fill(0xFF000000U);
    for (std::size_t i = 0; i < chosen_.size(); ++i)
        colours[i] = 0xFF000000U | static_cast<std::uint32_t>(chosen_[i].r) << 16 |
                     static_cast<std::uint32_t>(chosen_[i].g) << 8 |
                     static_cast<std::uint32_t>(chosen_[i].b);
    colours[kTransparent] = 0;
}

}  // namespace carom
