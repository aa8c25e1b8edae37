// Reading PNG files.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <vector>

#include "core/failure.h"
#include "media/png.h"
#include "media/png_writer.h"
#include "media/straight_alpha.h"

namespace carom {

namespace {

constexpr std::int64_t kMostPixels = 100'000'000;

class PngReader {
  public:
    PngReader() {
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &text_, carom_png_error,
                                      carom_png_warning);
        if (png_ != nullptr) info_ = png_create_info_struct(png_);
        if (info_ == nullptr) {
            png_destroy_read_struct(&png_, nullptr, nullptr);
            throw std::bad_alloc();
        }
    }
    ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;

    png_structp png() { return png_; }
    png_infop info() { return info_; }
    const char* text() const { return text_.text.data(); }

  private:
    PngText text_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

/// A file that closes itself.
struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using InputFile = std::unique_ptr<std::FILE, CloseFile>;

[[noreturn]] void fail_reading(const std::string& path, const std::string& why) {
    throw Failure(FailureKind::kInput, fmt::format("cannot read PNG '{}': {}", path, why));
}

/// Asks libpng for straight BGRA, 8 bits a sample, or 16 in the processor's order.
void set_reading_transforms(png_structp png, bool deep) {
    png_set_expand(png);  // palette, fewer than 8 bits, a transparent colour
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, deep ? 0xFFFF : 0xFF, PNG_FILLER_AFTER);
    png_set_bgr(png);
    if (deep) png_set_swap(png);  // the processor is little-endian, files are not
    png_set_interlace_handling(png);
}

/// The exponent of the file's gAMA chunk, where it counts and says something else than sRGB.
std::optional<double> other_gamma(png_structp png, png_infop info) {
    // What sRGB files carry for programs that know no more, and what counts as that: FFmpeg writes
    // 0.51 beside a film's frames, BT.709's curve, whose code values are those of sRGB pictures.
    constexpr double kOfSrgb = 0.45455, kNear = 0.15;
    double gamma = 0;
    if (png_get_valid(png, info, PNG_INFO_sRGB | PNG_INFO_iCCP) != 0) return std::nullopt;
    if (png_get_gAMA(png, info, &gamma) == 0 || !(gamma > 0)) return std::nullopt;
    if (std::abs(gamma / kOfSrgb - 1) <= kNear) return std::nullopt;
    return gamma;
}

/// IEC 61966-2-1 of light 0 ... 1.
double srgb_of_light(double light) {
    return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

/// Straight samples with `gamma` become sRGB ones; alpha stays.
template <class Picture>
void bring_to_srgb(Picture& picture, unsigned one, double gamma) {
    std::vector<unsigned> of(one + 1);
    for (unsigned v = 0; v <= one; ++v)
        of[v] = static_cast<unsigned>(
            std::lround(one * srgb_of_light(std::pow(double{1} * v / one, 1 / gamma))));
    for (std::size_t i = 0; i < picture.bgra.size(); ++i)
        if (i % 4 != 3) {
            auto& sample = picture.bgra[i];
            sample = static_cast<std::remove_reference_t<decltype(sample)>>(of[sample]);
        }
}

void premultiply_all(Image& image) { premultiply_image(image); }

void premultiply_all(DeepImage& image) {
    constexpr std::uint64_t kOne = 65535;
    for (std::size_t i = 0; i < image.bgra.size(); i += 4)
        for (std::size_t c = i; c < i + 3; ++c)
            image.bgra[c] = static_cast<std::uint16_t>(
                (std::uint64_t{image.bgra[c]} * image.bgra[i + 3] + kOne / 2) / kOne);
}

/// The pixels behind a head that is read; libpng's text where they cannot be.
template <class Picture>
bool read_pixels(PngReader& reader, Picture& picture, unsigned one) {
    png_structp png = reader.png();
    png_infop info = reader.info();
    constexpr std::size_t kSample = sizeof picture.bgra[0];
    const std::size_t row_samples = static_cast<std::size_t>(picture.width_px) * 4;
    std::vector<png_bytep> rows;
    for (std::size_t y = 0; y < static_cast<std::size_t>(picture.height_px); ++y)
        rows.push_back(reinterpret_cast<png_bytep>(picture.bgra.data() + y * row_samples));
    const std::optional<double> gamma = other_gamma(png, info);
    if (!guarded(png, [&] {
            set_reading_transforms(png, kSample == 2);
            png_read_update_info(png, info);
            if (png_get_rowbytes(png, info) != row_samples * kSample)
                png_error(png, "the samples cannot be brought to RGBA");
            png_read_image(png, rows.data());
            png_read_end(png, nullptr);
        }))
        return false;
    if (gamma) bring_to_srgb(picture, one, *gamma);
    premultiply_all(picture);
    return true;
}

}  // namespace

AnyImage read_any_png(const std::string& path) {
    const InputFile file(std::fopen(path.c_str(), "rbe"));
    if (!file) fail_reading(path, std::strerror(errno));
    PngReader reader;
    png_structp png = reader.png();
    png_infop info = reader.info();
    std::FILE* raw_file = file.get();

    if (!guarded(png, [&] {
            png_init_io(png, raw_file);
            png_read_info(png, info);
        }))
        fail_reading(path, reader.text());
    const auto width = static_cast<std::int64_t>(png_get_image_width(png, info));
    const auto height = static_cast<std::int64_t>(png_get_image_height(png, info));
    if (width * height > kMostPixels)
        fail_reading(path, fmt::format("{}x{} is more than 100 megapixels", width, height));

    if (png_get_bit_depth(png, info) == 16) {
        DeepImage deep(static_cast<int>(width), static_cast<int>(height));
        if (!read_pixels(reader, deep, 65535)) fail_reading(path, reader.text());
        return deep;
    }
    Image image(static_cast<int>(width), static_cast<int>(height));
    if (!read_pixels(reader, image, 255)) fail_reading(path, reader.text());
    return image;
}

Image read_png(const std::string& path) {
    AnyImage any = read_any_png(path);
    if (auto* image = std::get_if<Image>(&any)) return std::move(*image);
    return flattened(any);
}

}  // namespace carom
