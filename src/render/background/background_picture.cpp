#include "render/background/background_picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cstdint>

#include "render/blend/linear_layer.h"
#include "render/blend/picture_layer.h"
#include "render/view/view_space.h"

namespace carom {

namespace {

constexpr float kSky = 1e29f;  ///< depths beyond belong to no surface (surfaces.glsl: kFar)

}  // namespace

BackgroundPicture::BackgroundPicture(const Gl& gl, int width, int height,
                                     const BackgroundKind& kind, const GlTexture* given)
    : gl_(&gl), kind_(kind), given_color_(given) {
    if (given == nullptr)
        own_color_ = make_texture(gl, GL_SRGB8_ALPHA8, width, height, GL_RGBA, GL_UNSIGNED_BYTE);
    g_buffer_ = make_texture(gl, GL_RGBA32UI, width, height, GL_RGBA_INTEGER, GL_UNSIGNED_INT);
    if (kind.occludes)
        front_.emplace(make_texture(gl, GL_SRGB8_ALPHA8, width, height, GL_RGBA, GL_UNSIGNED_BYTE));
    if (kind.mirrors)
        mirror_.emplace(make_texture(gl, GL_RGBA32F, width, height, GL_RGBA, GL_FLOAT));
    color_framebuffer_ = make_framebuffer(gl, "copies of the background", {&color()});
    g_buffer_framebuffer_ = make_framebuffer(gl, "the G-buffer", {&g_buffer_});
    if (mirror_)
        mirror_framebuffer_ = make_framebuffer(gl, "mirror of the background", {&*mirror_});
}

std::vector<const GlTexture*> BackgroundPicture::targets() const {
    std::vector<const GlTexture*> targets = {&color(), &g_buffer_};
    if (front_) targets.push_back(&*front_);
    if (mirror_) targets.push_back(&*mirror_);
    return targets;
}

std::vector<const GlTexture*> BackgroundPicture::targets_without_edges() const {
    std::vector<const GlTexture*> targets = {&color(), &g_buffer_};
    if (mirror_) targets.push_back(&*mirror_);
    return targets;
}

void BackgroundPicture::lay_over(const Image& layer) {
    carom::lay_over(*gl_, layer, filled_part(layer), color_framebuffer_, color());
}

std::vector<TileBound> BackgroundPicture::tile_bounds(const View& view, int tile_px) const {
    const int width = view.width_px(), height = view.height_px();
    std::vector<std::uint32_t> g_buffer(4 * static_cast<std::size_t>(width) *
                                        static_cast<std::size_t>(height));
    gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, g_buffer_framebuffer_.name());
    gl_->ReadPixels(0, 0, width, height, GL_RGBA_INTEGER, GL_UNSIGNED_INT, g_buffer.data());
    gl_->check("reading the background back");

    const double pixel = pixel_width(view);
    const int columns = (width + tile_px - 1) / tile_px, rows = (height + tile_px - 1) / tile_px;
    std::vector<Eigen::AlignedBox3d> boxes(static_cast<std::size_t>(columns) *
                                           static_cast<std::size_t>(rows));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::size_t at =
                4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x));
            const Vec2 across((x + 0.5 - 0.5 * width) * pixel, (y + 0.5 - 0.5 * height) * pixel);
            Eigen::AlignedBox3d& box =
                boxes[static_cast<std::size_t>(y / tile_px) * static_cast<std::size_t>(columns) +
                      static_cast<std::size_t>(x / tile_px)];
            for (const std::size_t layer : {at, at + 1}) {
                const float depth = std::bit_cast<float>(g_buffer[layer]);
                if (!(depth < kSky)) continue;
                const double spread = view.orthographic() ? 1.0 : static_cast<double>(depth);
                box.extend(Vec3(across.x() * spread, across.y() * spread, depth));
            }
        }
    }
    std::vector<TileBound> bounds(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i)
        if (!boxes[i].isEmpty()) bounds[i] = {boxes[i].center(), 0.5 * boxes[i].diagonal().norm()};
    return bounds;
}

}  // namespace carom
