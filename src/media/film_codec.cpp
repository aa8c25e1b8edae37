#include "media/film_codec.h"

#include <algorithm>

namespace carom {

namespace {

using P = PixelFormat;

constexpr std::array<std::string_view, 3> kQualityNames = {"draft", "medium", "high"};

constexpr std::array kX264Pixels = {P::kYuv420, P::kYuv444, P::kYuv420Ten, P::kYuv444Ten};
constexpr std::array kSvtPixels = {P::kYuv420, P::kYuv420Ten};
constexpr std::array kVp9Pixels = {P::kYuv420, P::kYuva420, P::kYuv444, P::kYuv420Ten,
                                   P::kYuv444Ten};
constexpr std::array kProresPixels = {P::kYuv444Ten, P::kYuva444Ten};
constexpr std::array kFfv1Pixels = {P::kBgr0, P::kBgra};
constexpr std::array kGifPixels = {P::kPalette};
constexpr std::array kApngPixels = {P::kRgb, P::kRgba};
constexpr std::array kWebpPixels = {P::kBgra};
constexpr std::array kRawPixels = {P::kRgb,    P::kRgba,      P::kBgr0,   P::kBgra,
                                   P::kYuv420, P::kYuv420Ten, P::kYuv444, P::kYuv444Ten};
constexpr std::array kY4mPixels = {P::kYuv420, P::kYuv444, P::kYuv420Ten, P::kYuv444Ten};

constexpr std::array<std::string_view, 10> kX264Presets = {
    "ultrafast", "superfast", "veryfast", "faster",   "fast",
    "medium",    "slow",      "slower",   "veryslow", "placebo"};
constexpr std::array<std::string_view, 9> kVp9Presets = {"8", "7", "6", "5", "4",
                                                         "3", "2", "1", "0"};
constexpr std::array<std::string_view, 13> kAv1Presets = {"12", "11", "10", "9", "8", "7", "6",
                                                          "5",  "4",  "3",  "2", "1", "0"};

constexpr std::array<QualityStep, 3> kX264Quality = {
    QualityStep{28, "ultrafast"}, {18, "veryfast"}, {12, "medium"}};
constexpr std::array<QualityStep, 3> kX265Quality = {
    QualityStep{30, "ultrafast"}, {20, "veryfast"}, {14, "medium"}};
constexpr std::array<QualityStep, 3> kVp9Quality = {QualityStep{40, "8"}, {22, "5"}, {12, "3"}};
constexpr std::array<QualityStep, 3> kAv1Quality = {QualityStep{45, "12"}, {26, "10"}, {16, "7"}};
constexpr std::array<QualityStep, 3> kProresQuality = {QualityStep{12, ""}, {5, ""}, {2, ""}};
constexpr std::array<QualityStep, 3> kWebpQuality = {QualityStep{0, ""}, {1, ""}, {4, ""}};
constexpr std::array<QualityStep, 3> kApngQuality = {QualityStep{1, ""}, {6, ""}, {9, ""}};

// clang-format off
constexpr std::array kCodecs = {
    //         name      title          encoder            pixels         crf    presets       quality         threads cost
    FilmCodec{"h264",   "H.264",       "libx264",         kX264Pixels,   1, 51, kX264Presets, kX264Quality,   true,  {0.003, 5, 14}},
    FilmCodec{"h265",   "H.265",       "libx265",         kX264Pixels,   1, 51, kX264Presets, kX265Quality,   true,  {0.005, 24, 45}},
    FilmCodec{"av1",    "AV1",         "libsvtav1",       kSvtPixels,    1, 63, kAv1Presets,  kAv1Quality,    true,  {0.004, 34, 67}},
    FilmCodec{"vp9",    "VP9",         "libvpx-vp9",      kVp9Pixels,    1, 63, kVp9Presets,  kVp9Quality,    true,  {0.005, 29, 34}},
    FilmCodec{"prores", "ProRes 4444", "prores_ks",       kProresPixels, 0, 0,  {},           kProresQuality, true,  {0.17, 12, 18}},
    FilmCodec{"ffv1",   "FFV1",        "ffv1",            kFfv1Pixels,   0, 0,  {},           {},             true,  {0.155, 14, 45}},
    FilmCodec{"gif",    "GIF",         "gif",             kGifPixels,    0, 0,  {},           {},             false, {0.03, 18, 2}},
    FilmCodec{"apng",   "APNG",        "apng",            kApngPixels,   0, 0,  {},           kApngQuality,   false, {0.11, 80, 5}},
    FilmCodec{"webp",   "WebP",        "libwebp",         kWebpPixels,   0, 0,  {},           kWebpQuality,   false, {0.08, 150, 5}},
    FilmCodec{"raw",    "raw video",   "rawvideo",        kRawPixels,    0, 0,  {},           {},             false, {0, 1, 0}},
    FilmCodec{"y4m",    "YUV4MPEG2",   "wrapped_avframe", kY4mPixels,    0, 0,  {},           {},             false, {0, 2, 0}},
};
// clang-format on

}  // namespace

bool FilmCodec::has_alpha() const {
    return std::any_of(pixels.begin(), pixels.end(),
                       [](PixelFormat format) { return pixel_format_info(format).alpha; });
}

std::span<const FilmCodec> film_codecs() { return kCodecs; }

const FilmCodec* find_film_codec(std::string_view name) {
    const auto found = std::find_if(kCodecs.begin(), kCodecs.end(),
                                    [&](const FilmCodec& codec) { return codec.name == name; });
    return found == kCodecs.end() ? nullptr : &*found;
}

std::span<const std::string_view> quality_names() { return kQualityNames; }

}  // namespace carom
