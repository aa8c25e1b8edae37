#include "render/picture_mean.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/check.h"
#include "render/tile_program.h"

namespace carom {

TileMask::TileMask(int width_px, int height_px, int tile_px)
    : width_px_(width_px),
      height_px_(height_px),
      tile_px_(tile_px),
      columns_((width_px + tile_px - 1) / tile_px),
      rows_((height_px + tile_px - 1) / tile_px),
      set_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

void TileMask::add_tile(int column, int row) {
    CAROM_CHECK(column, <, columns_);
    CAROM_CHECK(row, <, rows_);
    const auto tile = static_cast<std::size_t>(row * columns_ + column);
    if (!set_[tile]) ++count_;
    set_[tile] = true;
}

void TileMask::add_all() { add(0, 0, width_px_, height_px_); }

void TileMask::add(double left_px, double top_px, double right_px, double bottom_px) {
    const auto tile = [&](double px, int most) {
        return static_cast<int>(std::clamp(std::floor(px / tile_px_), -1.0, double(most)));
    };
    const int first = std::max(0, tile(left_px, columns_));
    const int last = std::min(columns_ - 1, tile(right_px, columns_));
    const int bottom = std::min(rows_ - 1, tile(bottom_px, rows_));
    for (int row = std::max(0, tile(top_px, rows_)); row <= bottom; ++row)
        for (int column = first; column <= last; ++column) add_tile(column, row);
}

TileMask::Bounds TileMask::bounds() const {
    Bounds bounds{width_px_, height_px_, 0, 0};
    for (int row = 0; row < rows_; ++row) {
        for (int column = 0; column < columns_; ++column) {
            if (!set_[static_cast<std::size_t>(row * columns_ + column)]) continue;
            bounds.left = std::min(bounds.left, column * tile_px_);
            bounds.top = std::min(bounds.top, row * tile_px_);
            bounds.right = std::max(bounds.right, std::min(width_px_, (column + 1) * tile_px_));
            bounds.bottom = std::max(bounds.bottom, std::min(height_px_, (row + 1) * tile_px_));
        }
    }
    return bounds;
}

std::vector<float> TileMask::tiles() const {
    std::vector<float> tiles;
    for (int row = 0; row < rows_; ++row)
        for (int column = 0; column < columns_; ++column)
            if (set_[static_cast<std::size_t>(row * columns_ + column)])
                tiles.insert(tiles.end(),
                             {static_cast<float>(column), static_cast<float>(row), 0, 0});
    return tiles;
}

PictureMean::PictureMean(const Gl& gl, int width_px, int height_px)
    : gl_(&gl), width_px_(width_px), height_px_(height_px), vertex_array_(gl), tile_buffer_(gl) {
    sum_ = make_texture(gl, GL_RGBA32F, width_px, height_px, GL_RGBA, GL_FLOAT);
    framebuffer_ = make_framebuffer(gl, "the mean of pictures", {&sum_});
    program_ = make_tile_program(
        gl, {"mean of pictures", "mean_fragment", "u_picture", width_px, height_px, kTilePx},
        vertex_array_, tile_buffer_);
    gl.check("preparing the mean of pictures");
}

void PictureMean::begin(const TileMask& mask, int count) {
    const std::vector<float> tiles = mask.tiles();
    tiles_ = static_cast<GLsizei>(tiles.size() / 4);
    count_ = count;
    added_ = 0;
    gl_->BindBuffer(GL_ARRAY_BUFFER, tile_buffer_.name());
    gl_->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(tiles.size() * sizeof(float)),
                    tiles.data(), GL_STREAM_DRAW);
    gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    gl_->ClearColor(0, 0, 0, 0);
    gl_->Clear(GL_COLOR_BUFFER_BIT);
}

void PictureMean::compile(const GlTexture& picture, const GlFramebuffer& target) {
    constexpr std::array<float, 4> kFirstTile{};
    gl_->BindBuffer(GL_ARRAY_BUFFER, tile_buffer_.name());
    gl_->BufferData(GL_ARRAY_BUFFER, sizeof(kFirstTile), kFirstTile.data(), GL_STREAM_DRAW);
    tiles_ = 1;
    gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    draw_tiles(picture, 0, true);
    gl_->BindFramebuffer(GL_FRAMEBUFFER, target.name());
    draw_tiles(sum_, 0, false);
}

void PictureMean::draw_tiles(const GlTexture& from, double weight, bool added) {
    if (added) {
        gl_->Enable(GL_BLEND);
        gl_->BlendFuncSeparate(GL_ONE, GL_ONE, GL_ONE, GL_ONE);
    } else {
        gl_->Disable(GL_BLEND);
    }
    program_.set("u_weight", weight);
    gl_->ActiveTexture(GL_TEXTURE0);
    gl_->BindTexture(GL_TEXTURE_2D, from.name());
    gl_->BindVertexArray(vertex_array_.name());
    gl_->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, tiles_);
}

void PictureMean::add(const GlTexture& picture) {
    CAROM_CHECK(added_, <, count_);
    ++added_;
    gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    gl_->Viewport(0, 0, width_px_, height_px_);
    draw_tiles(picture, 1.0 / count_, true);
}

void PictureMean::write(const GlFramebuffer& target) {
    CAROM_CHECK(added_, ==, count_);
    gl_->BindFramebuffer(GL_FRAMEBUFFER, target.name());
    gl_->Viewport(0, 0, width_px_, height_px_);
    draw_tiles(sum_, 1.0, false);
}

}  // namespace carom
