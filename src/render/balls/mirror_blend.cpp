#include "render/balls/mirror_blend.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "render/blend/srgb.h"
#include "render/view/view_space.h"

namespace carom {

namespace {

/// Part of its light that a surface mirrors: as common.glsl has it.
double mirrored_share(double strength, double cosine) {
    const double away = 1 - std::clamp(cosine, 0.0, 1.0);
    return strength * (0.06 + 0.84 * away * away * away * away);
}

/// Rays r(t) = start + t d through pixels, d.z = 1 (common.glsl).
class Rays {
  public:
    explicit Rays(const View& view)
        : parallel_(view.orthographic()),
          pixel_(pixel_width(view)),
          middle_(0.5 * view.width_px(), 0.5 * view.height_px()) {}
    Vec3 place(int x, int y) const {
        return {(x + 0.5 - middle_.x()) * pixel_, (y + 0.5 - middle_.y()) * pixel_, 0};
    }
    Vec3 start(const Vec3& place) const { return parallel_ ? place : Vec3(Vec3::Zero()); }
    Vec3 direction(const Vec3& place) const {
        return parallel_ ? Vec3(Vec3::UnitZ()) : Vec3(place + Vec3::UnitZ());
    }
    /// Width of a pixel at a depth, m.
    double pixel_at(double depth) const { return parallel_ ? pixel_ : depth * pixel_; }

  private:
    bool parallel_;
    double pixel_;
    Vec2 middle_;
};

/// The part of a pixel that shows the mirror at the depth t: of either layer the one at that depth,
/// which changes by `slope` to the neighbouring pixels.
double part_at(const std::uint32_t* g_buffer, double t, double slope) {
    const double near = static_cast<double>(std::bit_cast<float>(g_buffer[0]));
    const double far = static_cast<double>(std::bit_cast<float>(g_buffer[1]));
    const double near_part = near == far ? 1 : (g_buffer[2] >> 20) / 1023.0;
    const double reach = 1e-4 * t + 0.6 * slope;
    return (std::abs(near - t) < reach ? near_part : 0) +
           (std::abs(far - t) < reach ? 1 - near_part : 0);
}

}  // namespace

void blend_images(const Mirror& mirror, const View& view, double fade_m, MirrorPart& part) {
    const Rays rays(view);
    const std::array<double, 256>& linear = srgb_decoding();
    const SrgbEncoder& encoded = srgb_encoder();
    const Vec3& normal = mirror.normal;
    std::size_t at = 0;
    for (int y = 0; y < part.height_px; ++y) {
        for (int x = 0; x < part.width_px; ++x, at += 4) {
            const float* image = &part.images[at];
            if (!(image[3] > 0)) continue;
            const Vec3 place = rays.place(part.left_px + x, part.top_px + y);
            const Vec3 start = rays.start(place), d = rays.direction(place);
            const double facing = normal.dot(d);
            if (facing >= -1e-7) continue;
            const double t = (mirror.offset - normal.dot(start)) / facing;
            const Vec3 p = start + t * d;
            const double aside = std::max(std::abs(mirror.axis_a.dot(p - mirror.middle)),
                                          std::abs(mirror.axis_b.dot(p - mirror.middle)));
            if (aside > 1.01) continue;
            const double slope =
                rays.pixel_at(t) * (std::abs(normal.x()) + std::abs(normal.y())) / -facing;
            double share = part_at(&part.g_buffer[at], t, slope);
            if (share <= 0) continue;
            share *= mirrored_share(mirror.strength, -facing / d.norm());
            if (mirror.fades && !view.orthographic()) {
                const double away = p.norm() / fade_m;
                share *= std::exp(-away * away);
            }
            const double hides = static_cast<double>(image[3]);
            std::uint8_t* to = &part.picture[at];
            for (int c = 0; c < 3; ++c) {
                // Light is in the order R, G, B.
                const std::size_t channel = 2 - static_cast<std::size_t>(c);
                const double hidden = hides * static_cast<double>(part.mirrored[at + channel]);
                to[c] = encoded(std::max(0.0, linear[to[c]] - hidden) +
                                share * static_cast<double>(image[channel]));
            }
        }
    }
}

}  // namespace carom
