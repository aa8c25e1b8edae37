#include "render/blend/picture_mean.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.h"
#include "render/blend/srgb.h"

namespace carom {

namespace {

constexpr double kWhite = 1 << 24;
static_assert(PictureMean::kMost * kWhite <= 4294967295.0);

}  // namespace

PictureMean::PictureMean() {
    for (std::size_t code = 0; code < light_.size(); ++code) {
        light_[code] = static_cast<std::uint32_t>(std::lround(kWhite * srgb_decoding()[code]));
        opacity_[code] =
            static_cast<std::uint32_t>(std::lround(kWhite * static_cast<double>(code) / 255));
    }
}

void PictureMean::begin(std::vector<TileMask::Part> parts, int count) {
    CAROM_CHECK(count, <=, kMost);
    std::size_t pixels = 0;
    for (const TileMask::Part& part : parts)
        for (const PixelRect& tile : part.tiles)
            pixels += static_cast<std::size_t>(tile.width() * tile.height());
    sums_.push_back({std::move(parts), count, 0, std::vector<std::uint32_t>(4 * pixels)});
}

void PictureMean::add(const Gl& gl, const GlFramebuffer& picture) {
    Sum& mean = sums_.back();
    CAROM_CHECK(mean.added, <, mean.count);
    ++mean.added;
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, picture.name());
    std::uint32_t* sum = mean.light.data();
    for (const TileMask::Part& part : mean.parts) {
        const PixelRect& all = part.bounds;
        const auto width = static_cast<std::size_t>(all.width());
        read_.resize(4 * width * static_cast<std::size_t>(all.height()));
        gl.ReadPixels(all.left, all.top, all.width(), all.height(), GL_BGRA, GL_UNSIGNED_BYTE,
                      read_.data());
        for (const PixelRect& tile : part.tiles) {
            for (int y = tile.top; y < tile.bottom; ++y) {
                const std::size_t first = static_cast<std::size_t>(y - all.top) * width +
                                          static_cast<std::size_t>(tile.left - all.left);
                const std::uint8_t* from = &read_[4 * first];
                for (int x = tile.left; x < tile.right; ++x, from += 4, sum += 4) {
                    sum[0] += light_[from[0]];
                    sum[1] += light_[from[1]];
                    sum[2] += light_[from[2]];
                    sum[3] += opacity_[from[3]];
                }
            }
        }
    }
}

void PictureMean::write(Image& picture) const {
    const SrgbEncoder& encoded = srgb_encoder();
    for (const Sum& mean : sums_) {
        CAROM_CHECK(mean.added, ==, mean.count);
        const double light = 1 / (kWhite * mean.count), opacity = 255 * light;
        const std::uint32_t* sum = mean.light.data();
        for (const TileMask::Part& part : mean.parts) {
            for (const PixelRect& tile : part.tiles) {
                for (int y = tile.top; y < tile.bottom; ++y) {
                    std::uint8_t* to = picture.row(y) + std::ptrdiff_t{4} * tile.left;
                    for (int x = tile.left; x < tile.right; ++x, to += 4, sum += 4) {
                        for (int c = 0; c < 3; ++c) to[c] = encoded(light * sum[c]);
                        to[3] = static_cast<std::uint8_t>(std::lround(opacity * sum[3]));
                    }
                }
            }
        }
    }
}

}  // namespace carom
