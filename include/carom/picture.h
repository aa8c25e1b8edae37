// Single pictures: drawn, read, written, compared.
#pragma once

#include <carom/second_run.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

CAROM_NAMESPACE_BEGIN

/// 8-bit sRGB, four bytes a pixel in the order R, G, B, A, alpha straight, rows from the top.
struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba{};  ///< height * width * 4 bytes
};

/// Draws one instant [s], in the scene's size, with a second run where one is given or the scene
/// names one (which is then simulated at each call: second_run() does it once for many). Needs no
/// display. Throws Error where neither OSMesa nor EGL is there, for an instant outside of the
/// motion, and for runs that cannot be shown together.
CAROM_API Picture still(const Scene& scene, const Motion& motion, double time,
                        const std::optional<Against>& against = {});

/// A new file appears under its name when it is whole. An existing one is replaced.
CAROM_API void write_png(const std::string& path, const Picture& picture);
/// Any PNG, in 8 bits.
CAROM_API Picture read_png(const std::string& path);

/// docs/commands.md says how these are defined.
struct Difference {
    bool same_size = true;
    double largest = 0;  ///< of any channel, in steps of 255
    std::int64_t differing_pixels = 0, pixels = 0;
    double psnr_db = 0;  ///< infinity when identical
    double ssim = 0;     ///< 1 when identical
};
CAROM_API Difference compare(const Picture& a, const Picture& b);

/// True where no channel is off by more than `tolerance` and no larger share of the pixels than
/// `max_differing` is off at all: the limits of `carom compare`.
CAROM_API bool same(const Difference& difference, double tolerance = 2,
                    double max_differing = 0.01);

CAROM_NAMESPACE_END
