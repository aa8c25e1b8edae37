#include "render/picture/picture_target.h"

#include <fmt/core.h>

#include <cstdint>
#include <cstring>

#include "core/check.h"
#include "core/failure.h"

namespace carom {

namespace {

constexpr float kMark = 0.3F;  ///< what no picture is where it is drawn
constexpr int kMarkByte = 77;

}  // namespace

PictureTarget::PictureTarget(OffscreenContext& context, int width_px, int height_px)
    : context_(context), gl_(context.gl()), width_px_(width_px), height_px_(height_px) {
    GLint largest = 0;
    gl_.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (width_px > largest || height_px > largest)
        throw Failure(FailureKind::kRun,
                      fmt::format("a picture of {} x {} pixels is too large: the driver draws at "
                                  "most {} x {}",
                                  width_px, height_px, largest, largest));
}

void PictureTarget::make_color() {
    color_ = make_texture(gl_, GL_SRGB8_ALPHA8, width_px_, height_px_, GL_RGBA, GL_UNSIGNED_BYTE);
}

void PictureTarget::restore(const std::vector<PixelRect>& parts,
                            const BackgroundPicture& background, const GlFramebuffer& frame) {
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, background.color_framebuffer().name());
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, frame.name());
    for (const PixelRect& part : parts)
        gl_.BlitFramebuffer(part.left, part.top, part.right, part.bottom, part.left, part.top,
                            part.right, part.bottom, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    aim(frame);
}

void PictureTarget::aim(const GlFramebuffer& frame) {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, frame.name());
    gl_.Viewport(0, 0, width_px_, height_px_);
}

void PictureTarget::read(const std::vector<PixelRect>& parts, const GlFramebuffer& frame,
                         Image& picture) {
    CAROM_CHECK(picture.width_px, ==, width_px_);
    CAROM_CHECK(picture.height_px, ==, height_px_);
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, frame.name());
    gl_.PixelStorei(GL_PACK_ROW_LENGTH, width_px_);
    for (const PixelRect& part : parts)
        gl_.ReadPixels(part.left, part.top, part.width(), part.height(), GL_BGRA, GL_UNSIGNED_BYTE,
                       picture.row(part.top) + std::ptrdiff_t{4} * part.left);
    gl_.PixelStorei(GL_PACK_ROW_LENGTH, 0);
    gl_.check("drawing a frame");
}

void PictureTarget::keep(const std::vector<PixelRect>& parts, const Image& picture) {
    kept_.clear();
    for (const PixelRect& part : parts)
        for (int y = part.top; y < part.bottom; ++y) {
            const std::uint8_t* row = picture.row(y);
            kept_.insert(kept_.end(), row + std::ptrdiff_t{4} * part.left,
                         row + std::ptrdiff_t{4} * part.right);
        }
}

std::vector<PixelRect> PictureTarget::differing(const std::vector<PixelRect>& parts,
                                                const Image& picture) const {
    std::vector<PixelRect> found;
    const std::uint8_t* kept = kept_.data();
    for (const PixelRect& part : parts) {
        const auto bytes = std::size_t{4} * static_cast<std::size_t>(part.width());
        bool differs = false;
        for (int y = part.top; y < part.bottom; ++y, kept += bytes)
            differs = differs ||
                      std::memcmp(kept, picture.row(y) + std::ptrdiff_t{4} * part.left, bytes) != 0;
        if (differs) found.push_back(part);
    }
    return found;
}

void PictureTarget::check_not_blank(bool transparent, const BackgroundPicture& background,
                                    const GlFramebuffer& frame) {
    expect_drawing(transparent, frame);
    const int x = width_px_ / 2, y = height_px_ / 2;
    restore({{x, y, x + 1, y + 1}}, background, frame);
    check_drawn(transparent, frame);
}

/// A picture is opaque, or, where it shows nothing, transparent; never in between where no edge is.
void PictureTarget::expect_drawing(bool transparent, const GlFramebuffer& frame) {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, frame.name());
    gl_.ClearColor(kMark, kMark, kMark, transparent ? kMark : 0.0F);
    gl_.Clear(GL_COLOR_BUFFER_BIT);
}

void PictureTarget::check_drawn(bool transparent, const GlFramebuffer& frame) {
    checked_ = true;
    std::uint8_t pixel[4] = {};
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, frame.name());
    gl_.ReadPixels(width_px_ / 2, height_px_ / 2, 1, 1, GL_BGRA, GL_UNSIGNED_BYTE, pixel);
    if (transparent ? pixel[3] == kMarkByte : pixel[3] != 255)
        throw Failure(FailureKind::kRun, "the driver draws blank pictures and reports no error (" +
                                             context_.renderer() + ")");
}

}  // namespace carom
