// What a scene says of its film, the same for all that make one.
#pragma once

#include "media/frame_sink.h"
#include "scene/scene.h"

namespace carom {

/// Size, frame rate, transparency and title of the scene's film; the rest as FilmOptions has it.
FilmOptions film_options_of(const Scene& scene);

}  // namespace carom
