// Builds a scene in code, simulates it, asks for states, films it.
#include <carom/carom.h>

#include <cstdio>

int main(int argc, char** argv) {
    carom::SceneBuilder builder;
    builder.duration(1).material("rubber", 0.8).plane("floor", {0, 0, 1}, 0);
    builder.ball({.name = "a", .position = {0, 0, 0.6}, .radius = 0.1, .material = "rubber"});
    const carom::Scene scene = builder.set("film.size", "[160, 90]").set("film.fps", "20").build();
    const carom::Motion motion = carom::simulate(scene);
    std::printf("bounces to %.6f m, film of %lld frames\n", motion.peaks(0).at(0).height,
                static_cast<long long>(carom::film(scene, motion, argc > 1 ? argv[1] : "film.mp4",
                                                   {.quality = "draft", .overwrite = true})));
}
