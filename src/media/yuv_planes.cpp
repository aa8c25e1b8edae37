#include "media/yuv_planes.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace carom {

namespace {

// BT.709 as in yuv420.cpp, with 16 binary digits: off by at most 0.02 of a step of 10 bits.
constexpr int kFixedBits = 16;

constexpr int to_fixed(double x) {
    return static_cast<int>(x * (1 << kFixedBits) + (x < 0 ? -0.5 : 0.5));
}

/// Y' = offset + (r R + g G + b B) / 2^16 for samples of this many bits; likewise Cb and Cr.
struct Coefficients {
    int yr, yg, yb, cbr, cbg, cbb, crr, crg, crb;
};

constexpr Coefficients coefficients(int bits) {
    const double scale = 1 << (bits - 8);
    const double red = 0.2126, blue = 0.0722;
    const double luma = 219.0 / 255 * scale;
    const double cb = 224.0 / 255 / 1.8556 * scale, cr = 224.0 / 255 / 1.5748 * scale;
    Coefficients c{};
    c.yr = to_fixed(luma * red), c.yb = to_fixed(luma * blue), c.yg = to_fixed(luma) - c.yr - c.yb;
    c.cbr = to_fixed(-cb * red), c.cbb = to_fixed(cb * (1 - blue)), c.cbg = -c.cbr - c.cbb;
    c.crr = to_fixed(cr * (1 - red)), c.crb = to_fixed(-cr * blue), c.crg = -c.crr - c.crb;
    return c;
}

/// Where a plane's samples go, in their own width.
template <class Sample>
Sample* samples(const FramePlanes& planes, std::size_t plane, int y) {
    return reinterpret_cast<Sample*>(planes.data[plane] + y * planes.stride[plane]);
}

template <int kSampleBits, class Sample>
void convert_luma(const Image& image, const PixelRect& part, const FramePlanes& planes) {
    constexpr Coefficients c = coefficients(kSampleBits);
    constexpr int kOffset = (16 << (kSampleBits - 8 + kFixedBits)) + (1 << (kFixedBits - 1));
    for (int y = part.top; y < part.bottom; ++y) {
        const std::uint8_t* p = image.row(y) + std::ptrdiff_t{4} * part.left;
        Sample* out = samples<Sample>(planes, 0, y);
        for (int x = part.left; x < part.right; ++x, p += 4)
            out[x] = static_cast<Sample>((c.yr * p[2] + c.yg * p[1] + c.yb * p[0] + kOffset) >>
                                         kFixedBits);
    }
}

/// Chroma of a sum of `1 << kWeightBits` pixels.
template <int kSampleBits, int kWeightBits, class Sample>
void put_chroma(int b, int g, int r, Sample& cb, Sample& cr) {
    constexpr Coefficients c = coefficients(kSampleBits);
    constexpr int kShift = kFixedBits + kWeightBits;
    constexpr int kOffset = (128 << (kSampleBits - 8 + kShift)) + (1 << (kShift - 1));
    cb = static_cast<Sample>((c.cbr * r + c.cbg * g + c.cbb * b + kOffset) >> kShift);
    cr = static_cast<Sample>((c.crr * r + c.crg * g + c.crb * b + kOffset) >> kShift);
}

template <int kSampleBits, class Sample>
void convert_chroma(const Image& image, const PixelRect& part, const FramePlanes& planes) {
    for (int y = part.top; y < part.bottom; ++y) {
        const std::uint8_t* p = image.row(y) + std::ptrdiff_t{4} * part.left;
        Sample* cb = samples<Sample>(planes, 1, y);
        Sample* cr = samples<Sample>(planes, 2, y);
        for (int x = part.left; x < part.right; ++x, p += 4)
            put_chroma<kSampleBits, 0>(p[0], p[1], p[2], cb[x], cr[x]);
    }
}

template <int kSampleBits, class Sample>
void convert_halved_chroma(const Image& image, const PixelRect& part, const FramePlanes& planes) {
    constexpr int kWeightBits = 3;  // (1 + 2 + 1) * (1 + 1) = 8
    // The pair to the right takes in the part's last column.
    const int last = std::min(image.width_px, (part.right & ~1) + 2);
    for (int y = part.top & ~1; y < part.bottom; y += 2) {
        const std::uint8_t* upper = image.row(y);
        const std::uint8_t* lower = image.row(y + 1);
        Sample* cb = samples<Sample>(planes, 1, y / 2);
        Sample* cr = samples<Sample>(planes, 2, y / 2);
        for (int x = part.left & ~1; x < last; x += 2) {
            const int left = 4 * std::max(x - 1, 0), here = 4 * x, right = 4 * (x + 1);
            const auto sum = [&](int c) {
                return upper[left + c] + lower[left + c] + 2 * (upper[here + c] + lower[here + c]) +
                       upper[right + c] + lower[right + c];
            };
            put_chroma<kSampleBits, kWeightBits>(sum(0), sum(1), sum(2), cb[x / 2], cr[x / 2]);
        }
    }
}

}  // namespace

void convert_yuv(const Image& image, const PixelRect& part, int bits, bool halved_chroma,
                 const FramePlanes& planes) {
    constexpr int kTen = 10;
    if (bits == kTen) {
        convert_luma<kTen, std::uint16_t>(image, part, planes);
        if (halved_chroma)
            convert_halved_chroma<kTen, std::uint16_t>(image, part, planes);
        else
            convert_chroma<kTen, std::uint16_t>(image, part, planes);
        return;
    }
    CAROM_CHECK(bits, ==, 8);
    CAROM_CHECK(halved_chroma, ==, false);  // that is Yuv420Converter
    convert_luma<8, std::uint8_t>(image, part, planes);
    convert_chroma<8, std::uint8_t>(image, part, planes);
}

void copy_alpha(const Image& image, int bits, std::uint8_t* plane, std::ptrdiff_t stride) {
    const int most = (1 << bits) - 1;
    for (int y = 0; y < image.height_px; ++y) {
        const std::uint8_t* p = image.row(y) + 3;
        std::uint8_t* bytes = plane + y * stride;
        auto* words = reinterpret_cast<std::uint16_t*>(bytes);
        for (int x = 0; x < image.width_px; ++x, p += 4) {
            if (bits == 8)
                bytes[x] = *p;
            else
                words[x] = static_cast<std::uint16_t>((*p * most + 127) / 255);
        }
    }
}

}  // namespace carom
