#include "media/straight_alpha.h"

namespace carom {

namespace {

void prepare(const Image& like, Image& image) {
    if (image.width_px != like.width_px || image.height_px != like.height_px)
        image = Image(like.width_px, like.height_px);
}

}  // namespace

void straighten_row(const std::uint8_t* bgra, std::uint8_t* rgba, int width) {
    for (int x = 0; x < width; ++x, bgra += 4, rgba += 4) {
        const unsigned a = bgra[3];
        rgba[0] = straighten(bgra[2], a);
        rgba[1] = straighten(bgra[1], a);
        rgba[2] = straighten(bgra[0], a);
        rgba[3] = bgra[3];
    }
}

void straighten_image(const Image& premultiplied, Image& straight) {
    prepare(premultiplied, straight);
    for (std::size_t i = 0; i < premultiplied.bgra.size(); i += 4) {
        const unsigned a = premultiplied.bgra[i + 3];
        for (std::size_t c = i; c < i + 3; ++c)
            straight.bgra[c] =
                a == 255 ? premultiplied.bgra[c] : straighten(premultiplied.bgra[c], a);
        straight.bgra[i + 3] = static_cast<std::uint8_t>(a);
    }
}

void premultiply_image(Image& image) {
    for (std::size_t i = 0; i < image.bgra.size(); i += 4) {
        const unsigned a = image.bgra[i + 3];
        if (a == 255) continue;
        for (std::size_t c = i; c < i + 3; ++c) image.bgra[c] = premultiply(image.bgra[c], a);
    }
}

void StraightAlpha::gather(const Image& premultiplied) {
    int width = premultiplied.width_px, height = premultiplied.height_px;
    std::size_t count = 0;
    while (width > 1 || height > 1 || count == 0) {
        const int fine_width = width, fine_height = height;
        width = (width + 1) / 2;
        height = (height + 1) / 2;
        if (levels_.size() == count) levels_.emplace_back();
        Level& level = levels_[count];
        level.width = width;
        level.height = height;
        level.blocks.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), {});
        for (int y = 0; y < fine_height; ++y)
            for (int x = 0; x < fine_width; ++x) {
                Block& block = level.blocks[static_cast<std::size_t>(y / 2 * width + x / 2)];
                if (count == 0) {
                    const std::uint8_t* p = premultiplied.row(y) + 4 * x;
                    block.b += p[0], block.g += p[1], block.r += p[2], block.a += p[3];
                } else {
                    const Block& p =
                        levels_[count - 1].blocks[static_cast<std::size_t>(y * fine_width + x)];
                    block.b += p.b, block.g += p.g, block.r += p.r, block.a += p.a;
                }
            }
        ++count;
    }
    levels_.resize(count);
}

void StraightAlpha::spread() {
    for (std::size_t i = levels_.size() - 1; i-- > 0;) {
        Level& level = levels_[i];
        const Level& coarse = levels_[i + 1];
        for (int y = 0; y < level.height; ++y)
            for (int x = 0; x < level.width; ++x) {
                Block& block = level.blocks[static_cast<std::size_t>(y * level.width + x)];
                if (block.a == 0)
                    block = coarse.blocks[static_cast<std::size_t>(y / 2 * coarse.width + x / 2)];
            }
    }
}

void StraightAlpha::convert(const Image& premultiplied, Image& straight) {
    straighten_image(premultiplied, straight);
    gather(premultiplied);
    spread();
    const Level& near = levels_.front();
    for (int y = 0; y < straight.height_px; ++y)
        for (int x = 0; x < straight.width_px; ++x) {
            std::uint8_t* p = straight.row(y) + 4 * x;
            if (p[3] != 0) continue;
            const Block& block = near.blocks[static_cast<std::size_t>(y / 2 * near.width + x / 2)];
            if (block.a == 0) continue;  // nothing anywhere
            const auto mean = [&](std::uint64_t sum) {
                return static_cast<std::uint8_t>(
                    std::min<std::uint64_t>(255, (sum * 255 + block.a / 2) / block.a));
            };
            p[0] = mean(block.b), p[1] = mean(block.g), p[2] = mean(block.r);
        }
}

}  // namespace carom
