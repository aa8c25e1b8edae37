#include "report/scene_film.h"

namespace carom {

FilmOptions film_options_of(const Scene& scene) {
    FilmOptions film;
    film.width_px = scene.film.width_px;
    film.height_px = scene.film.height_px;
    film.fps_numerator = scene.film.fps.numerator;
    film.fps_denominator = scene.film.fps.denominator;
    film.transparent = scene.background == Background::kTransparent;
    film.title = scene.title;
    return film;
}

}  // namespace carom
