#include "render/picture_layer.h"

#include <algorithm>
#include <array>

#include "core/check.h"
#include "render/linear_layer.h"
#include "render/tile_program.h"

namespace carom {

PictureLayer::PictureLayer(const Gl& gl, int width_px, int height_px)
    : gl_(&gl),
      width_px_(width_px),
      height_px_(height_px),
      columns_((width_px + kTilePx - 1) / kTilePx),
      rows_((height_px + kTilePx - 1) / kTilePx),
      filled_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)),
      vertex_array_(gl),
      tile_buffer_(gl) {
    const Image empty(width_px, height_px);
    texture_ = make_texture(gl, GL_RGBA8, width_px, height_px, GL_BGRA, GL_UNSIGNED_BYTE,
                            empty.bgra.data());
    program_ =
        make_tile_program(gl, {"layer", "layer_fragment", "u_layer", width_px, height_px, kTilePx},
                          vertex_array_, tile_buffer_);
    gl.check("preparing a layer");
}

bool PictureLayer::tile_is_empty(const Image& layer, int column, int row) const {
    const int right = std::min(width_px_, (column + 1) * kTilePx);
    const int bottom = std::min(height_px_, (row + 1) * kTilePx);
    for (int y = row * kTilePx; y < bottom; ++y) {
        const std::uint8_t* pixels = layer.row(y);
        for (int x = column * kTilePx; x < right; ++x)
            if (pixels[4 * x + 3] != 0) return false;
    }
    return true;
}

void PictureLayer::update(const Image& layer, int x, int y, int width, int height) {
    CAROM_CHECK(layer.width_px, ==, width_px_);
    CAROM_CHECK(layer.height_px, ==, height_px_);
    const int left = std::max(0, x), top = std::max(0, y);
    const int right = std::min(width_px_, x + width), bottom = std::min(height_px_, y + height);
    if (left >= right || top >= bottom) return;

    gl_->ActiveTexture(GL_TEXTURE0);
    gl_->BindTexture(GL_TEXTURE_2D, texture_.name());
    gl_->PixelStorei(GL_UNPACK_ROW_LENGTH, width_px_);
    gl_->TexSubImage2D(GL_TEXTURE_2D, 0, left, top, right - left, bottom - top, GL_BGRA,
                       GL_UNSIGNED_BYTE, layer.row(top) + std::ptrdiff_t{4} * left);
    gl_->PixelStorei(GL_UNPACK_ROW_LENGTH, 0);

    for (int row = top / kTilePx; row * kTilePx < bottom; ++row) {
        for (int column = left / kTilePx; column * kTilePx < right; ++column) {
            const auto tile = static_cast<std::size_t>(row * columns_ + column);
            const bool filled = !tile_is_empty(layer, column, row);
            if (filled_[tile] == filled) continue;
            filled_[tile] = filled;
            tiles_changed_ = true;
        }
    }
}

void PictureLayer::draw() {
    if (tiles_changed_) {
        std::vector<float> tiles;
        for (int row = 0; row < rows_; ++row)
            for (int column = 0; column < columns_; ++column)
                if (filled_[static_cast<std::size_t>(row * columns_ + column)])
                    tiles.insert(tiles.end(),
                                 {static_cast<float>(column), static_cast<float>(row), 0, 0});
        gl_->BindBuffer(GL_ARRAY_BUFFER, tile_buffer_.name());
        gl_->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(tiles.size() * sizeof(float)),
                        tiles.data(), GL_DYNAMIC_DRAW);
        filled_count_ = static_cast<int>(tiles.size() / 4);
        tiles_changed_ = false;
    }
    draw_tiles(filled_count_);
}

void PictureLayer::compile() {
    constexpr std::array<float, 4> kFirstTile{};
    gl_->BindBuffer(GL_ARRAY_BUFFER, tile_buffer_.name());
    gl_->BufferData(GL_ARRAY_BUFFER, sizeof(kFirstTile), kFirstTile.data(), GL_DYNAMIC_DRAW);
    tiles_changed_ = true;
    draw_tiles(1);
}

void PictureLayer::draw_tiles(int count) {
    if (count == 0) return;
    program_.use();
    gl_->ActiveTexture(GL_TEXTURE0);
    gl_->BindTexture(GL_TEXTURE_2D, texture_.name());
    gl_->BindVertexArray(vertex_array_.name());
    gl_->Enable(GL_BLEND);
    gl_->BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl_->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
}

void lay_over_once(const Gl& gl, const Image& layer, const GlFramebuffer& target,
                   const GlTexture& color) {
    const LayerBounds part = filled_part(layer);
    if (part.empty()) return;
    Image below(part.right - part.left, part.bottom - part.top);
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, target.name());
    gl.ReadPixels(part.left, part.top, below.width_px, below.height_px, GL_BGRA, GL_UNSIGNED_BYTE,
                  below.bgra.data());
    lay_over_in_linear_light(layer, part.left, part.top, below);
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_2D, color.name());
    gl.TexSubImage2D(GL_TEXTURE_2D, 0, part.left, part.top, below.width_px, below.height_px,
                     GL_BGRA, GL_UNSIGNED_BYTE, below.bgra.data());
    gl.check("laying a layer over a picture");
}

}  // namespace carom
