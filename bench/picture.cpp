// Quality beside cost of a picture: how far it is from 64 samples a pixel, averaged in linear
// light, and what drawing and reading a frame takes. usage: picture [FRAMES [BALLS...]]
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/check.h"
#include "crowd.h"
#include "render/blend/srgb.h"
#include "render/painter.h"

namespace carom {
namespace {

constexpr int kWidth = 640, kHeight = 360;
constexpr int kSamples = 8;  ///< along a pixel's edge
constexpr double kFps = 60;

/// Of the size that all are drawn at here.
Scene crowd(int balls, bool moving_camera, double shutter_deg) {
    return crowd_scene({balls, kWidth, kHeight, kFps, moving_camera, shutter_deg});
}

/// Light of pictures of one size, added up.
class Light {
  public:
    void add(const Image& picture) {
        sum_.resize(picture.bgra.size());
        for (std::size_t i = 0; i < sum_.size(); ++i) sum_[i] += srgb_decoding()[picture.bgra[i]];
        ++pictures_;
    }
    /// The mean of all pictures and of blocks of `block` by `block` pixels.
    Image mean(int width, int block) const {
        const int out_width = width / block;
        const auto height = static_cast<int>(sum_.size() / 4) / width;
        Image out(out_width, height / block);
        for (int y = 0; y < out.height_px; ++y)
            for (int x = 0; x < out.width_px; ++x)
                for (int c = 0; c < 4; ++c) {
                    double light = 0;
                    for (int k = 0; k < block * block; ++k)
                        light += sum_[static_cast<std::size_t>(
                            4 * ((y * block + k / block) * width + x * block + k % block) + c)];
                    out.row(y)[4 * x + c] =
                        c == 3 ? 255 : srgb_encoder()(light / (block * block * pictures_));
                }
        return out;
    }

  private:
    std::vector<double> sum_;
    int pictures_ = 0;
};

struct Quality {
    double psnr_db = 0;
    double beyond_2 = 0;  ///< share of the pixels
};

Quality quality(const Image& picture, const Image& reference) {
    double squares = 0;
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < picture.bgra.size(); i += 4) {
        int worst = 0;
        for (std::size_t c = i; c < i + 3; ++c) {
            const int off = std::abs(int{picture.bgra[c]} - int{reference.bgra[c]});
            worst = std::max(worst, off);
            squares += off * off;
        }
        beyond += worst > 2 ? 1 : 0;
    }
    const double pixels = static_cast<double>(picture.bgra.size()) / 4;
    return {10 * std::log10(255 * 255 / (squares / (3 * pixels))),
            static_cast<double>(beyond) / pixels};
}

/// 64 samples a pixel at the instant t, of a camera that stands where it is then.
Image reference_at(const Scene& scene, const Motion& motion, double t) {
    PainterOptions options{.width_px = kSamples * kWidth, .height_px = kSamples * kHeight};
    options.only_at = t;
    options.few_pictures = true;
    Painter painter(scene, motion, options);
    Image large;
    painter.paint(t, large);
    Light light;
    light.add(large);
    return light.mean(large.width_px, kSamples);
}

/// Median CPU milliseconds of a frame, drawn and read, the first left out.
double frame_ms(Painter& painter, int frames) {
    Image picture;
    std::vector<double> each;
    double before = 0;
    for (int k = 0; k < frames; ++k) {
        painter.paint_next(0.5 + k / kFps, picture);
        const double now = painter.draw_cpu_s() + painter.read_cpu_s();
        if (k > 0) each.push_back(1000 * (now - before));
        before = now;
    }
    std::nth_element(each.begin(), each.begin() + frames / 2, each.end());
    return each[static_cast<std::size_t>(frames / 2)];
}

void sharp(int balls, bool moving_camera, int frames) {
    constexpr double kSpeed = 0.5, kAt = 0.5;
    const Scene scene = crowd(balls, moving_camera, 0);
    const Motion motion = crowd_motion(scene, kSpeed);
    Painter painter(scene, motion, {.width_px = kWidth, .height_px = kHeight});
    const double ms = frame_ms(painter, frames);
    Image picture;
    painter.paint(kAt, picture);
    const Quality found = quality(picture, reference_at(scene, motion, kAt));
    fmt::print("{:>6}  {:<8}{:>10.2f}{:>10.1f}{:>12.3f} %\n", balls,
               moving_camera ? "moving" : "standing", ms, found.psnr_db, 100 * found.beyond_2);
}

/// Of an open shutter: means of so many sharp pictures, and what the painter does by itself,
/// against 512.
void blurred(int balls, int frames) {
    constexpr double kSpeed = 3, kAt = 0.5, kOpen_s = 0.5 / kFps;  // 180 degrees
    constexpr int kMany = 512;
    const Scene still = crowd(balls, false, 0);
    const Motion motion = crowd_motion(still, kSpeed);
    Painter painter(still, motion, {.width_px = kWidth, .height_px = kHeight});
    const auto mean_of = [&](int count) {
        Light light;
        Image picture;
        for (int i = 0; i < count; ++i) {
            painter.paint(kAt + kOpen_s * ((i + 0.5) / count - 0.5), picture);
            light.add(picture);
        }
        return light.mean(kWidth, 1);
    };
    const Image reference = mean_of(kMany);
    const auto line = [&](const std::string& what, double ms, const Image& picture) {
        const Quality found = quality(picture, reference);
        fmt::print("{:>6}  {:<14}{:>10.2f}{:>10.1f}{:>12.3f} %\n", balls, what, ms, found.psnr_db,
                   100 * found.beyond_2);
    };
    for (int count = 4; count <= 128; count *= 2) {
        const double before = painter.draw_cpu_s() + painter.read_cpu_s();
        const Image picture = mean_of(count);
        line(fmt::format("{} instants", count),
             1000 * (painter.draw_cpu_s() + painter.read_cpu_s() - before), picture);
    }
    const Scene open = crowd(balls, false, 180);
    Painter own(open, motion, {.width_px = kWidth, .height_px = kHeight});
    const double ms = frame_ms(own, frames);
    Image picture;
    own.paint(kAt, picture);
    line("as drawn", ms, picture);
}

int run(int frames, const std::vector<int>& counts) {
    fmt::print("{}x{}, {} balls\n", kWidth, kHeight, "striped");
    fmt::print("{:>6}  {:<8}{:>10}{:>10}{:>14}\n", "balls", "camera", "CPU ms", "PSNR dB",
               "off by > 2");
    for (const int balls : counts)
        for (const bool moving : {false, true}) sharp(balls, moving, frames);
    fmt::print("\n{:>6}  {:<14}{:>10}{:>10}{:>14}\n", "balls", "open shutter", "CPU ms", "PSNR dB",
               "off by > 2");
    for (const int balls : counts)
        if (balls <= 100) blurred(balls, frames);
    return EXIT_SUCCESS;
}

}  // namespace
}  // namespace carom

int main(int argc, char** argv) {
    const int frames = argc > 1 ? std::atoi(argv[1]) : 30;
    std::vector<int> counts;
    for (int i = 2; i < argc; ++i) counts.push_back(std::atoi(argv[i]));
    if (counts.empty()) counts = {5, 100, 1000, 10000};
    if (frames < 3 || *std::min_element(counts.begin(), counts.end()) < 1) {
        std::fputs("usage: picture [FRAMES [BALLS...]], at least 3 frames and 1 ball\n", stderr);
        return 2;
    }
    return carom::run(frames, counts);
}
