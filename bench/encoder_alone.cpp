// What encoding alone costs: the frames of a film are drawn into memory, some at a time, and only
// encoding them is counted, on all of the encoder's threads. Prints CPU milliseconds a frame of
// converting and of encoding. usage: encoder_alone SCENE WIDTHxHEIGHT [PRESET]
#include <fmt/core.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "core/check.h"
#include "media/film_choice.h"
#include "media/video_encoder.h"
#include "render/painter.h"
#include "scene/film_clock.h"
#include "scene/reader.h"
#include "sim/simulate.h"

namespace carom {
namespace {

/// Pictures in memory at a time: 500 MB of 1920x1080.
constexpr std::int64_t kBatch = 60;

int measure(const std::string& path, const std::string& size, const std::string& preset) {
    const std::size_t cross = size.find('x');
    const std::string width = size.substr(0, cross), height = size.substr(cross + 1);
    const SceneResult read =
        read_scene_file(path, {{"film.size", fmt::format("[{}, {}]", width, height)}});
    if (!read.scene) return EXIT_FAILURE;
    const Scene& scene = *read.scene;
    const Film& film = scene.film;
    const SimulationResult result = simulate(scene);
    Painter painter(scene, result.motion, {film.width_px, film.height_px});

    FilmOptions options;
    options.width_px = film.width_px;
    options.height_px = film.height_px;
    options.fps_numerator = film.fps.numerator;
    options.fps_denominator = film.fps.denominator;
    options.preset = preset;
    VideoEncoder encoder("film.mp4", choose_film("film.mp4", options), options, true);
    std::int64_t bytes = 0;
    const auto take = [&](AVPacket& packet) { bytes += packet.size; };

    const std::int64_t frames = frame_count(film, result.motion.duration);
    std::vector<Image> pictures(kBatch);
    for (std::int64_t first = 0; first < frames; first += kBatch) {
        const std::int64_t end = std::min(frames, first + kBatch);
        for (std::int64_t k = first; k < end; ++k)
            painter.paint(frame_time(film, k), pictures[static_cast<std::size_t>(k - first)]);
        for (std::int64_t k = first; k < end; ++k)
            encoder.encode(pictures[static_cast<std::size_t>(k - first)], {}, take);
    }
    encoder.flush(take);
    const double per_frame = 1000.0 / static_cast<double>(frames);
    fmt::print("{} {:.3f} {:.3f} {}\n", frames, encoder.convert_cpu_s() * per_frame,
               encoder.encode_cpu_s() * per_frame, bytes);
    return EXIT_SUCCESS;
}

}  // namespace
}  // namespace carom

int main(int argc, char** argv) {
    if (argc < 3) {
        fmt::print(stderr, "usage: encoder_alone SCENE WIDTHxHEIGHT [PRESET]\n");
        return 2;
    }
    return carom::measure(argv[1], argv[2], argc > 3 ? argv[3] : "veryfast");
}
