#include <carom/picture.h>
#include <fmt/format.h>

#include "api/inner.h"
#include "api/painting.h"
#include "core/image_measures.h"
#include "media/png.h"
#include "media/straight_alpha.h"

namespace carom::v1 {

namespace {

Picture public_picture(const Image& image) {
    Picture picture{image.width_px, image.height_px, {}};
    picture.rgba.resize(image.bgra.size());
    for (int y = 0; y < image.height_px; ++y)
        straighten_row(image.row(y),
                       picture.rgba.data() + static_cast<std::size_t>(y) * image.stride_bytes(),
                       image.width_px);
    return picture;
}

Image inner_picture(const Picture& picture) {
    const auto pixels =
        static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
    if (picture.width <= 0 || picture.height <= 0 || picture.rgba.size() != 4 * pixels)
        throw Error(fmt::format("a picture of {}x{} with {} bytes; it has to have {}",
                                picture.width, picture.height, picture.rgba.size(), 4 * pixels));
    Image image(picture.width, picture.height);
    for (std::size_t i = 0; i < image.bgra.size(); i += 4) {
        image.bgra[i] = picture.rgba[i + 2];
        image.bgra[i + 1] = picture.rgba[i + 1];
        image.bgra[i + 2] = picture.rgba[i];
        image.bgra[i + 3] = picture.rgba[i + 3];
    }
    premultiply_image(image);
    return image;
}

}  // namespace

Picture still(const Scene& scene, const Motion& motion, double time,
              const std::optional<Against>& against) {
    return translated([&] {
        require_own_motion(scene, motion);
        require_instant(motion, time);
        const std::optional<SecondRun> second = run_to_show(scene, motion, against, {});
        PainterOptions options = painter_options(scene, second);
        options.few_pictures = true;
        options.only_at = time;
        Painter painter(scene.impl().scene, motion.impl().motion, options);
        Image image;
        painter.paint(time, image);
        return public_picture(image);
    });
}

void write_png(const std::string& path, const Picture& picture) {
    translated([&] {
        carom::write_png(path, inner_picture(picture));
        return 0;
    });
}

Picture read_png(const std::string& path) {
    return translated([&] { return public_picture(carom::read_png(path)); });
}

Difference compare(const Picture& a, const Picture& b) {
    return translated([&] {
        const ImageMeasures m = measure_difference(inner_picture(a), inner_picture(b));
        return Difference{m.same_size, m.largest, m.differing, m.pixels, m.psnr_db, m.ssim};
    });
}

bool same(const Difference& difference, double tolerance, double max_differing) {
    return difference.same_size && difference.largest <= tolerance &&
           static_cast<double>(difference.differing_pixels) <=
               max_differing * static_cast<double>(difference.pixels);
}

}  // namespace carom::v1
