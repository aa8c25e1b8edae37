#include "media/png_row_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <optional>
#include <vector>

#include "core/check.h"
#include "core/failure.h"
#include "core/image.h"
#include "media/png_writer.h"
#include "media/straight_alpha.h"

namespace carom {

namespace {

constexpr std::int64_t kMostPixels = 100'000'000;
constexpr std::uint16_t kDeepStep = 257;  // 255 of 255 is 65535 of 65535

/// A file that closes itself.
struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using InputFile = std::unique_ptr<std::FILE, CloseFile>;

/// libpng's reader.
struct ReadStructs {
    explicit ReadStructs(PngText& text)
        : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &text, carom_png_error,
                                     carom_png_warning)) {
        if (png != nullptr) info = png_create_info_struct(png);
        if (info == nullptr) {
            png_destroy_read_struct(&png, nullptr, nullptr);
            throw std::bad_alloc();
        }
    }
    ~ReadStructs() { png_destroy_read_struct(&png, &info, nullptr); }
    ReadStructs(const ReadStructs&) = delete;
    ReadStructs& operator=(const ReadStructs&) = delete;

    png_structp png = nullptr;
    png_infop info = nullptr;
};

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

/// What straight samples 0 ... `one` with `gamma` become.
std::vector<std::uint16_t> srgb_of_samples(unsigned one, double gamma) {
    std::vector<std::uint16_t> table(one + 1);
    for (unsigned v = 0; v <= one; ++v)
        table[v] = static_cast<std::uint16_t>(
            std::lround(one * srgb_of_light(std::pow(double{1} * v / one, 1 / gamma))));
    return table;
}

void premultiply_row(std::uint8_t* bgra, std::size_t samples) {
    std::uint8_t all = 255;
    for (std::size_t i = 3; i < samples; i += kChannels) all &= bgra[i];
    if (all == 255) return;
    for (std::size_t i = 0; i < samples; i += kChannels)
        for (std::size_t c = i; c < i + 3; ++c) bgra[c] = premultiply(bgra[c], bgra[i + 3]);
}

void premultiply_row(std::uint16_t* bgra, std::size_t samples) {
    constexpr std::uint64_t kOne = 65535;
    for (std::size_t i = 0; i < samples; i += kChannels)
        for (std::size_t c = i; c < i + 3; ++c)
            bgra[c] = static_cast<std::uint16_t>((std::uint64_t{bgra[c]} * bgra[i + 3] + kOne / 2) /
                                                 kOne);
}

}  // namespace

class PngRowReader::Impl {
  public:
    explicit Impl(const std::string& path) : path_(path), file_(std::fopen(path.c_str(), "rbe")) {
        if (!file_) fail_reading(path, std::strerror(errno));
        read_head();
    }

    std::int64_t width() const { return png_get_image_width(png_, info_); }
    std::int64_t height() const { return png_get_image_height(png_, info_); }
    bool is_deep() const { return png_get_bit_depth(png_, info_) == 16; }

    /// Rows of this depth: Sample is the file's own.
    template <class Sample>
    void read(Sample* bgra, int rows) {
        if (!begun_) begin(sizeof(Sample) == 2);
        const std::size_t samples = static_cast<std::size_t>(width_) * kChannels;
        if (interlaced_) {
            std::memcpy(bgra, whole_.data() + static_cast<std::size_t>(done_) * stride(),
                        static_cast<std::size_t>(rows) * stride());
        } else if (!guarded(png_, [&] {
                       for (int y = 0; y < rows; ++y)
                           png_read_row(png_,
                                        reinterpret_cast<png_bytep>(
                                            bgra + static_cast<std::size_t>(y) * samples),
                                        nullptr);
                   })) {
            fail();
        }
        done_ += rows;
        for (int y = 0; y < rows; ++y, bgra += samples) {
            if (!srgb_.empty())
                for (std::size_t i = 0; i < samples; ++i)
                    if (i % kChannels != 3) bgra[i] = static_cast<Sample>(srgb_[bgra[i]]);
            premultiply_row(bgra, samples);
        }
        if (done_ == height_) end();
    }

  private:
    void read_head() {
        std::FILE* file = file_.get();
        if (!guarded(png_, [&] {
#ifdef PNG_IGNORE_ADLER32
                // Chunks have checksums of their own: a second one of all samples is a tenth of the
                // time.
                png_set_option(png_, PNG_IGNORE_ADLER32, PNG_OPTION_ON);
#endif
                png_init_io(png_, file);
                png_read_info(png_, info_);
            }))
            fail();
        if (width() * height() > kMostPixels)
            fail_reading(path_,
                         fmt::format("{}x{} is more than 100 megapixels", width(), height()));
    }

    std::size_t stride() const { return static_cast<std::size_t>(width_) * pixel_bytes_; }

    void begin(bool deep) {
        begun_ = true;
        width_ = static_cast<int>(width());
        height_ = static_cast<int>(height());
        pixel_bytes_ = kChannels * (deep ? 2 : 1);
        interlaced_ = png_get_interlace_type(png_, info_) != PNG_INTERLACE_NONE;
        if (const std::optional<double> gamma = other_gamma(png_, info_))
            srgb_ = srgb_of_samples(deep ? 65535 : 255, *gamma);
        if (!guarded(png_, [&] {
                set_reading_transforms(png_, deep);
                png_read_update_info(png_, info_);
                if (png_get_rowbytes(png_, info_) != stride())
                    png_error(png_, "the samples cannot be brought to RGBA");
            }))
            fail();
        if (interlaced_) read_whole();
    }

    void read_whole() {
        whole_.resize(static_cast<std::size_t>(height_) * stride());
        std::vector<png_bytep> rows;
        for (std::size_t y = 0; y < static_cast<std::size_t>(height_); ++y)
            rows.push_back(whole_.data() + y * stride());
        if (!guarded(png_, [&] { png_read_image(png_, rows.data()); })) fail();
    }

    void end() {
        if (!guarded(png_, [&] { png_read_end(png_, nullptr); })) fail();
    }

    [[noreturn]] void fail() const { fail_reading(path_, text_.text.data()); }

    std::string path_;
    InputFile file_;
    PngText text_;
    ReadStructs structs_{text_};
    png_structp png_ = structs_.png;
    png_infop info_ = structs_.info;
    bool begun_ = false, interlaced_ = false;
    int width_ = 0, height_ = 0, done_ = 0;
    std::size_t pixel_bytes_ = kChannels;  ///< of a pixel
    std::vector<std::uint16_t> srgb_;      ///< of a sample; empty: as it is
    std::vector<std::uint8_t> whole_;      ///< of an interlaced file
};

PngRowReader::PngRowReader(const std::string& path)
    : impl_(std::make_unique<Impl>(path)),
      width_px_(static_cast<int>(impl_->width())),
      height_px_(static_cast<int>(impl_->height())),
      deep_(impl_->is_deep()) {}
PngRowReader::~PngRowReader() = default;

void PngRowReader::read(std::uint8_t* bgra, int rows) {
    CAROM_CHECK(deep_, ==, false);
    impl_->read(bgra, rows);
}

void PngRowReader::read(std::uint16_t* bgra, int rows) {
    if (deep_) {
        impl_->read(bgra, rows);
        return;
    }
    std::vector<std::uint8_t> flat(static_cast<std::size_t>(width_px_) * kChannels);
    for (int y = 0; y < rows; ++y, bgra += flat.size()) {
        impl_->read(flat.data(), 1);
        std::transform(flat.begin(), flat.end(), bgra,
                       [](std::uint8_t v) { return static_cast<std::uint16_t>(v * kDeepStep); });
    }
}

}  // namespace carom
