#include "render/balls/ball_reflections.h"

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
      // Not in codes of sRGB: drivers round these by what the maker of the processor thinks right.
      layer_(make_texture(gl, GL_RGBA32F, view.width_px(), view.height_px(), GL_RGBA, GL_FLOAT)),
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
    std::vector<PixelRect> parts;
    for (const BallInView& image : images)
        if (may_be_seen(image, view_)) parts.push_back(bounds_in_picture(image, view_));
    return apart(parts, kMostParts);
}

void BallReflections::draw(const std::vector<BallInView>& balls,
                           const BackgroundPicture& background, const GlFramebuffer& frame,
                           const GlTexture& color) {
    for (const Mirror& mirror : mirrors_) {
        const std::vector<BallInView> images = mirror_images(balls, mirror, view_);
        const std::vector<PixelRect> parts = parts_of(images);
        if (parts.empty()) continue;
        for (const PixelRect& part : parts) clear_layer(part);
        gl_->BindFramebuffer(GL_FRAMEBUFFER, layer_framebuffer_.name());
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

void BallReflections::clear_layer(const PixelRect& part) {
    read_.images.assign(
        4 * static_cast<std::size_t>(part.width()) * static_cast<std::size_t>(part.height()), 0.0F);
    gl_->ActiveTexture(GL_TEXTURE0);
    gl_->BindTexture(GL_TEXTURE_2D, layer_.name());
    gl_->TexSubImage2D(GL_TEXTURE_2D, 0, part.left, part.top, part.width(), part.height(), GL_RGBA,
                       GL_FLOAT, read_.images.data());
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
    fetch(layer_framebuffer_, GL_RGBA, GL_FLOAT, read.images);
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
