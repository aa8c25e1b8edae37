// One film on its way into all its outputs, for `render`.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "cli/against.h"
#include "cli/encoding_options.h"
#include "cli/interrupt.h"
#include "cli/kept_work.h"
#include "cli/layer_options.h"
#include "cli/options.h"
#include "cli/outputs.h"
#include "cli/stats.h"
#include "render/painter.h"
#include "report/growing_motion.h"

namespace carom {

/// What `render` was asked for.
struct RenderOptions {
    std::string scene;
    std::vector<std::string> outputs;
    std::vector<std::string> sounds;  ///< those of the outputs that are taken apart
    std::string format = "mp4";
    bool sound = false;  ///< --sound
    std::string frames;
    std::string chunk;
    bool resume = false;
    bool dry_run = false;
    AgainstOptions against;
    CommonOptions common;
    EncodingOptions encoding;
    LayerOptions layers;

    /// --resume replaces what is not as it should be.
    bool replaces() const { return common.overwrite || resume; }
};

std::vector<OutputRequest> requests(const RenderOptions& options);

/// A film on its way into all its outputs.
class Filming {
  public:
    /// `growing` is null where the motion is there.
    Filming(const RenderOptions& options, const Interrupt& interrupt, const FilmSource& source,
            GrowingMotion* growing)
        : options_(options), interrupt_(interrupt), source_(source), growing_(growing) {}

    void open() {
        EncodingOptions encoding = options_.encoding;
        encoding.existing = existing_of(options_.replaces());
        for (const OutputRequest& output : requests(options_))
            sinks_.push_back(open_output(output, source_, encoding));
    }

    /// Layers beside the frames, where they are wanted; all must outlive it.
    void open_layers(const Scene& scene, const Motion& motion, const SecondRun* second);

    /// Draws and writes all frames; throws Interrupted when it has kept what is playable.
    void film(Painter& painter);

    void add_to(Stats& stats) const {
        for (const auto& sink : sinks_) stats.add_sink(sink->times());
        if (layers_) stats.layers_cpu_s = layers_->cpu_s();
    }

  private:
    bool has_film() const;
    void draw_all(Painter& painter, KeptWork* kept);
    void keep_partial() const;
    void write_layers(std::int64_t frame, const Film& film);

    const RenderOptions& options_;
    const Interrupt& interrupt_;
    const FilmSource& source_;
    GrowingMotion* growing_;
    std::vector<std::unique_ptr<FrameSink>> sinks_;
    std::unique_ptr<LayerFiles> layers_;  ///< null: none are wanted
    std::int64_t frame_count_ = 0;        ///< of the whole film
    std::int64_t done_ = 0;
};

}  // namespace carom
