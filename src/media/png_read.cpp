// Whole pictures from PNG files.
#include "media/png.h"
#include "media/png_row_reader.h"

namespace carom {

AnyImage read_any_png(const std::string& path) {
    PngRowReader reader(path);
    if (reader.is_deep()) {
        DeepImage deep(reader.width_px(), reader.height_px());
        reader.read(deep.bgra.data(), deep.height_px);
        return deep;
    }
    Image image(reader.width_px(), reader.height_px());
    reader.read(image.bgra.data(), image.height_px);
    return image;
}

Image read_png(const std::string& path) {
    AnyImage any = read_any_png(path);
    if (auto* image = std::get_if<Image>(&any)) return std::move(*image);
    return flattened(any);
}

}  // namespace carom
