#include "render/balls/ball_reflections.h"

#include <algorithm>
#include <cmath>

namespace carom {

BallReflections::BallReflections(const Gl& gl, const Scene& scene, const View& view,
                                 const Lights& lights, const PictureScale& scale,
                                 const BallSurroundings& around)
    : gl_(&gl),
      scene_(&scene),
      view_(view),
      lights_(lights),
      scale_(scale),
      mirrors_(find_mirrors(scene, view)),
      balls_(gl, scene, view, lights, around, std::nullopt, BallBillboards::Kind::kImages),
      layer_(make_texture(gl, GL_SRGB8_ALPHA8, view.width_px(), view.height_px(), GL_RGBA,
                          GL_UNSIGNED_BYTE)),
      layer_framebuffer_(make_framebuffer(gl, "mirror images", {&layer_})) {}

void BallReflections::set_view(const View& view, const Lights& lights, const PictureScale& scale) {
    view_ = view;
    lights_ = lights;
    scale_ = scale;
    mirrors_ = find_mirrors(*scene_, view);
    balls_.set_view(view, lights);
}

std::vector<BallInView> BallReflections::images(const std::vector<BallInView>& balls) const {
    std::vector<BallInView> all;
    for (const Mirror& mirror : mirrors_)
        for (const BallInView& image : mirror_images(balls, mirror, view_))
            if (may_be_seen(image, view_)) all.push_back(image);
    return all;
}

std::vector<PixelRect> BallReflections::parts_of(const std::vector<BallInView>& images) const {
    constexpr std::size_t kMostParts = 32;  // where many are, they lie together
    const PixelRect whole{0, 0, view_.width_px(), view_.height_px()};
    std::vector<PixelRect> parts;
    for (const BallInView& image : images) {
        if (!may_be_seen(image, view_)) continue;
        const Outline outline = project_sphere(image.center, image.radius, view_);
        if (!outline.is_ellipse) return {whole};
        const double x = std::hypot(outline.major.x(), outline.minor.x()) + 1;
        const double y = std::hypot(outline.major.y(), outline.minor.y()) + 1;
        const auto px = [](double at, int size) {
            return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(size)));
        };
        parts.push_back({px(outline.center.x() - x, whole.right),
                         px(outline.center.y() - y, whole.bottom),
                         px(outline.center.x() + x + 1, whole.right),
                         px(outline.center.y() + y + 1, whole.bottom)});
    }
    return apart(parts, kMostParts);
}

void BallReflections::draw(const std::vector<BallInView>& balls,
                           const BackgroundPicture& background, const GlFramebuffer& frame,
                           const GlTexture& color) {
    for (const Mirror& mirror : mirrors_) {
        const std::vector<BallInView> images = mirror_images(balls, mirror, view_);
        const std::vector<PixelRect> parts = parts_of(images);
        if (parts.empty()) continue;
        gl_->BindFramebuffer(GL_FRAMEBUFFER, layer_framebuffer_.name());
        gl_->ClearColor(0, 0, 0, 0);
        gl_->Clear(GL_COLOR_BUFFER_BIT);
        balls_.set_mirror(mirror.normal, mirror.offset, lights_);
        balls_.draw(images, background);
        for (const PixelRect& part : parts) blend(mirror, part, background, frame, color);
        gl_->BindFramebuffer(GL_FRAMEBUFFER, frame.name());
    }
}

void BallReflections::compile(const BackgroundPicture& background, const GlFramebuffer& frame) {
    if (mirrors_.empty()) return;
    gl_->BindFramebuffer(GL_FRAMEBUFFER, layer_framebuffer_.name());
    balls_.set_mirror(mirrors_.front().normal, mirrors_.front().offset, lights_);
    balls_.compile(background);
    gl_->BindFramebuffer(GL_FRAMEBUFFER, frame.name());
}

void BallReflections::blend(const Mirror& mirror, const PixelRect& part,
                            const BackgroundPicture& background, const GlFramebuffer& frame,
                            const GlTexture& color) {
    MirrorPart& read = read_;
    read.left_px = part.left;
    read.top_px = part.top;
    read.width_px = part.width();
    read.height_px = part.height();
    const std::size_t values =
        4 * static_cast<std::size_t>(read.width_px) * static_cast<std::size_t>(read.height_px);
    const auto fetch = [&](const GlFramebuffer& from, GLenum format, GLenum type, auto& to) {
        to.resize(values);
        gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, from.name());
        gl_->ReadPixels(part.left, part.top, read.width_px, read.height_px, format, type,
                        to.data());
    };
    fetch(layer_framebuffer_, GL_BGRA, GL_UNSIGNED_BYTE, read.images);
    fetch(frame, GL_BGRA, GL_UNSIGNED_BYTE, read.picture);
    fetch(background.g_buffer_framebuffer(), GL_RGBA_INTEGER, GL_UNSIGNED_INT, read.g_buffer);
    fetch(background.mirror_framebuffer(), GL_RGBA, GL_FLOAT, read.mirrored);
    blend_images(mirror, view_, scale_.fade_m, read);
    gl_->ActiveTexture(GL_TEXTURE0);
    gl_->BindTexture(GL_TEXTURE_2D, color.name());
    gl_->TexSubImage2D(GL_TEXTURE_2D, 0, part.left, part.top, read.width_px, read.height_px,
                       GL_BGRA, GL_UNSIGNED_BYTE, read.picture.data());
    gl_->check("laying mirror images over the picture");
}

}  // namespace carom
