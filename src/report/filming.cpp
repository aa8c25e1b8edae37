#include "report/filming.h"

#include <malloc.h>

#include "core/check.h"
#include "scene/film_clock.h"

namespace carom {

std::int64_t film_frames(Painter& painter, const Film& film, const FrameRanges& frames,
                         const std::vector<std::unique_ptr<FrameSink>>& sinks,
                         const FilmingHooks& hooks) {
    CAROM_CHECK(sinks.empty(), ==, false);
    std::int64_t done = 0;
    Image picture;
    ChangedParts changed;
    for (const std::int64_t frame : frames) {
        if (hooks.stops && hooks.stops()) break;
        const auto draw = [&] {
            const double t = frame_time(film, frame);
            if (hooks.await) hooks.await(t);
            changed = painter.paint_next(t, picture);
        };
        if (hooks.run_drawing)
            hooks.run_drawing(draw);
        else
            draw();
        for (std::size_t i = 0; i + 1 < sinks.size(); ++i)
            sinks[i]->write_changed(frame, picture, changed);
        // The driver has compiled its shaders by now: tens of megabytes that only the compiler
        // needed go back before the encoder grows.
        if (done == 0) malloc_trim(0);
        if (painter.draws_each_anew())
            sinks.back()->write_swapped(frame, picture);  // nobody else needs it: no copy
        else
            sinks.back()->write_changed(frame, picture, changed);
        ++done;
        if (hooks.written) hooks.written(done);
    }
    return done;
}

}  // namespace carom
