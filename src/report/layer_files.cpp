#include "report/layer_files.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/in_parallel.h"
#include "media/exr.h"
#include "media/png_gray16.h"
#include "media/thread_clock.h"
#include "report/layer_index.h"
#include "scene/film_clock.h"

namespace carom {

LayerInstants instants_of_frame(const Film& film, std::int64_t k, std::int64_t count) {
    LayerInstants instants{frame_time(film, k), {}, {}};
    if (k + 1 < count) instants.next = frame_time(film, k + 1);
    if (k > 0) instants.previous = frame_time(film, k - 1);
    return instants;
}

LayerInstants instants_of_still(const Film& film, double t, double duration) {
    const double frame_s = 1 / film.fps.per_second();
    const double next = motion_time(film, film_time(film, t) + frame_s);
    const double previous = motion_time(film, film_time(film, t) - frame_s);
    LayerInstants instants{t, {}, {}};
    if (next <= duration) instants.next = next;
    if (previous >= 0) instants.previous = previous;
    return instants;
}

void require_layer_libraries(const std::vector<LayerKind>& kinds) {
    for (const LayerKind kind : kinds)
        if (!layer_kind_info(kind).channels.empty()) require_openexr();
}

std::string layer_path(const std::string& picture_path, const LayerKindInfo& kind) {
    std::filesystem::path path(picture_path);
    path.replace_extension();
    path += "." + std::string(kind.name) + (kind.channels.empty() ? ".png" : ".exr");
    return path.string();
}

class LayerFiles::Impl {
  public:
    Impl(const Scene& scene, const Motion& motion, const LayerSettings& settings,
         std::string index_path, Existing existing, Durability durability)
        : scene_(scene),
          motion_(motion),
          settings_(settings),
          index_path_(std::move(index_path)),
          existing_(existing),
          durability_(durability),
          painter_(scene, motion, settings) {
        require_layer_libraries(settings.kinds);
        for (const LayerKind kind : settings.kinds) {
            const auto& names = layer_kind_info(kind).channels;
            encoders_.push_back(names.empty()
                                    ? nullptr
                                    : std::make_unique<ExrEncoder>(
                                          std::vector<std::string>(names.begin(), names.end())));
        }
    }

    void write(const std::string& picture_path, const std::optional<std::int64_t>& frame,
               const LayerInstants& instants) {
        const double begin = calling_thread_cpu_s();
        painter_.paint(instants.time, instants.next, instants.previous);
        others_cpu_s_ += in_parallel(static_cast<int>(settings_.kinds.size()), [&](int place) {
            const auto i = static_cast<std::size_t>(place);
            write_layer(settings_.kinds[i], encoders_[i].get(), picture_path);
        });
        written_ =
            layer_index_frame(scene_, motion_, settings_, painter_, picture_path, frame, instants);
        own_cpu_s_ += calling_thread_cpu_s() - begin;
    }

    void add_to_index() { frames_.push_back(std::move(written_)); }
    void finish() {
        write_text_file(index_path_, layer_index(layer_index_head(scene_, settings_), frames_),
                        durability_, existing_);
    }
    double cpu_s() const { return own_cpu_s_ + others_cpu_s_ + painter_.others_cpu_s(); }

  private:
    void write_layer(LayerKind kind, ExrEncoder* encoder, const std::string& picture_path) {
        const LayerKindInfo& info = layer_kind_info(kind);
        const std::string bytes =
            encoder == nullptr
                ? encode_gray16(settings_.width_px, settings_.height_px, painter_.ids())
                : encoder->encode(painter_.image(kind),
                                  [this](const PixelRect& rect) { return painter_.changed(rect); });
        write_text_file(layer_path(picture_path, info), bytes, durability_, existing_);
    }

    const Scene& scene_;
    const Motion& motion_;
    LayerSettings settings_;
    std::string index_path_;
    Existing existing_;
    Durability durability_;
    LayerPainter painter_;
    std::vector<std::unique_ptr<ExrEncoder>> encoders_;  ///< of each kind; none for ids
    std::string written_;                                ///< of the last picture
    std::vector<std::string> frames_;                    ///< of all that belong to the index
    double own_cpu_s_ = 0, others_cpu_s_ = 0;
};

LayerFiles::LayerFiles(const Scene& scene, const Motion& motion, const LayerSettings& settings,
                       std::string index_path, Existing existing, Durability durability)
    : impl_(std::make_unique<Impl>(scene, motion, settings, std::move(index_path), existing,
                                   durability)) {}
LayerFiles::~LayerFiles() = default;
void LayerFiles::write(const std::string& picture_path, const std::optional<std::int64_t>& frame,
                       const LayerInstants& instants) {
    impl_->write(picture_path, frame, instants);
}
void LayerFiles::add_to_index() { impl_->add_to_index(); }
void LayerFiles::finish() { impl_->finish(); }
double LayerFiles::cpu_s() const { return impl_->cpu_s(); }

}  // namespace carom
