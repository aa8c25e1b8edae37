#include "media/yuv420.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "core/check.h"

// The loops below are written for the compiler to vectorise; it makes one version for processors
// with AVX2 and one for all, and the program picks at its start. Sanitizers need their own start-up
// before such a choice, so they get the plain loops.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__) && !defined(__clang__)
#define CAROM_VECTOR_LOOP __attribute__((target_clones("avx2", "default"), optimize("O3")))
#else
#define CAROM_VECTOR_LOOP
#endif

namespace carom {

namespace {

static_assert(std::endian::native == std::endian::little, "pixels are read as 0xAARRGGBB");

// Fixed point: 16 binary digits. Each coefficient is off by at most 2^-17, a sum of three times 255
// by at most 0.006 of a step.
constexpr int kBits = 16;
constexpr double kOne = 1 << kBits;

constexpr int fixed(double x) { return static_cast<int>(x < 0 ? x * kOne - 0.5 : x * kOne + 0.5); }

constexpr double kRed = 0.2126, kBlue = 0.0722;
constexpr double kLuma = 219.0 / 255.0;
constexpr double kCb = 224.0 / 255.0 / 1.8556;
constexpr double kCr = 224.0 / 255.0 / 1.5748;

// Green's coefficient (0.7152) is what the others leave of the sum, so that rounding keeps grey
// grey.
constexpr int kYr = fixed(kLuma * kRed), kYb = fixed(kLuma * kBlue);
constexpr int kYg = fixed(kLuma) - kYr - kYb;
constexpr int kCbr = fixed(-kCb * kRed), kCbb = fixed(kCb * (1 - kBlue)), kCbg = -kCbr - kCbb;
constexpr int kCrr = fixed(kCr * (1 - kRed)), kCrb = fixed(-kCr * kBlue), kCrg = -kCrr - kCrb;

constexpr int kChromaWeightBits = 3;  // (1 + 2 + 1) * (1 + 1) = 8
constexpr int kChromaBits = kBits + kChromaWeightBits;
constexpr int kYOffset = (16 << kBits) + (1 << (kBits - 1));
constexpr int kCOffset = (128 << kChromaBits) + (1 << (kChromaBits - 1));

/// Luma of one row of pixels 0xAARRGGBB.
CAROM_VECTOR_LOOP void luma_row(const std::uint32_t* __restrict pixels, std::uint8_t* __restrict y,
                                int width) {
    for (int x = 0; x < width; ++x) {
        const std::uint32_t p = pixels[x];
        const int b = static_cast<int>(p & 0xFF);
        const int g = static_cast<int>((p >> 8) & 0xFF);
        const int r = static_cast<int>((p >> 16) & 0xFF);
        y[x] = static_cast<std::uint8_t>((kYr * r + kYg * g + kYb * b + kYOffset) >> kBits);
    }
}

/// Sums of two rows: blue in the low and red in the high 16 bits, green by itself.
CAROM_VECTOR_LOOP void add_rows(const std::uint32_t* __restrict upper,
                                const std::uint32_t* __restrict lower,
                                std::uint32_t* __restrict blue_red, std::uint32_t* __restrict green,
                                int width) {
    for (int x = 0; x < width; ++x) {
        const std::uint32_t p = upper[x], q = lower[x];
        blue_red[x] = (p & 0x00FF00FF) + (q & 0x00FF00FF);
        green[x] = ((p >> 8) & 0xFF) + ((q >> 8) & 0xFF);
    }
}

/// Chroma of two rows from their sums; the sums begin one pixel before the row.
CAROM_VECTOR_LOOP void chroma_row(const std::uint32_t* __restrict blue_red,
                                  const std::uint32_t* __restrict green,
                                  std::uint8_t* __restrict cb, std::uint8_t* __restrict cr,
                                  int half_width) {
    for (int i = 0; i < half_width; ++i) {
        // At most 8 * 255 = 2040 in each half: nothing carries over from blue into red.
        const std::uint32_t br = blue_red[2 * i] + 2 * blue_red[2 * i + 1] + blue_red[2 * i + 2];
        const int g = static_cast<int>(green[2 * i] + 2 * green[2 * i + 1] + green[2 * i + 2]);
        const int b = static_cast<int>(br & 0xFFFF);
        const int r = static_cast<int>(br >> 16);
        cb[i] =
            static_cast<std::uint8_t>((kCbr * r + kCbg * g + kCbb * b + kCOffset) >> kChromaBits);
        cr[i] =
            static_cast<std::uint8_t>((kCrr * r + kCrg * g + kCrb * b + kCOffset) >> kChromaBits);
    }
}

}  // namespace

void Yuv420Converter::convert(const Image& image, const PixelRect& part,
                              const Yuv420Planes& planes) {
    CAROM_CHECK(image.width_px % 2, ==, 0);
    CAROM_CHECK(image.height_px % 2, ==, 0);
    if (part.empty()) return;
    // Whole pairs, and the one to the right, whose chroma takes in the part's last column.
    const int left = part.left & ~1, top = part.top & ~1;
    const int right = std::min(image.width_px, (part.right & ~1) + 2);
    const int bottom = std::min(image.height_px, (part.bottom + 1) & ~1);
    const int before = left > 0 ? 1 : 0;  // chroma takes in the pixel to the left
    const int width = right - left;
    const auto pixels = static_cast<std::size_t>(before + width);
    blue_red_.resize(static_cast<std::size_t>(width) + 1);
    green_.resize(static_cast<std::size_t>(width) + 1);
    upper_.resize(pixels);
    lower_.resize(pixels);
    const int sums_from = 1 - before;

    for (int y = top; y < bottom; y += 2) {
        // Bytes B, G, R, A are the number 0xAARRGGBB on a little-endian machine.
        const std::ptrdiff_t from = std::ptrdiff_t{4} * (left - before);
        std::memcpy(upper_.data(), image.row(y) + from, 4 * pixels);
        std::memcpy(lower_.data(), image.row(y + 1) + from, 4 * pixels);
        luma_row(upper_.data() + before, planes.y + y * planes.y_stride + left, width);
        luma_row(lower_.data() + before, planes.y + (y + 1) * planes.y_stride + left, width);
        add_rows(upper_.data(), lower_.data(), blue_red_.data() + sums_from,
                 green_.data() + sums_from, before + width);
        if (before == 0) {
            blue_red_[0] = blue_red_[1];  // the left edge repeated
            green_[0] = green_[1];
        }
        chroma_row(blue_red_.data(), green_.data(), planes.cb + y / 2 * planes.cb_stride + left / 2,
                   planes.cr + y / 2 * planes.cr_stride + left / 2, width / 2);
    }
}

}  // namespace carom
