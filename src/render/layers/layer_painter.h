// Layers of a picture: what its pixels show, in numbers (docs/layers.md).
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "core/float_image.h"
#include "core/pixel_rect.h"
#include "motion/motion.h"
#include "render/layers/layer_kind.h"
#include "render/layers/optical_flow.h"
#include "render/layers/snapshot.h"
#include "render/runs/second_run.h"
#include "render/view/camera.h"
#include "scene/scene.h"

namespace carom {

/// How much of a ball a picture shows. All that it would show if nothing stood before the ball is
/// one run of pixels in each column.
struct BallShare {
    struct Run {
        int top = 0, bottom = 0;  ///< half open
    };
    int left = 0;           ///< column of the first run
    std::vector<Run> runs;  ///< column after column; empty where the picture would not show it
    std::int64_t whole_px = 0;
    std::int64_t visible_px = 0;
};

struct LayerSettings {
    int width_px = 1280;
    int height_px = 720;
    std::vector<LayerKind> kinds;       ///< without doubles
    const SecondRun* second = nullptr;  ///< whose ghosts the picture shows: the camera sees both
};

/// Every value is that of the ray through a pixel's centre, computed in double: of the nearest
/// body, never mixed at edges, at one instant, without overlay, ghosts and mirror images.
///
/// Where the camera stands, only tiles of the picture are made anew that a ball is or was near.
/// Needs no GL. Memory: the layers, and 16 bytes a pixel.
class LayerPainter {
  public:
    /// All must outlive it. Failure(kInput) for more bodies than ids have room for.
    LayerPainter(const Scene& scene, const Motion& motion, const LayerSettings& settings);
    ~LayerPainter();
    LayerPainter(const LayerPainter&) = delete;
    LayerPainter& operator=(const LayerPainter&) = delete;

    /// The instant t [s of the motion]; the others are those of the frames after and before it.
    /// Without one the way there is not a number, and hidden.
    void paint(double t, const std::optional<double>& next, const std::optional<double>& previous);

    /// Of the last instant; a kind that is wanted and has channels.
    const FloatImage& image(LayerKind kind) const;
    const std::vector<std::uint16_t>& ids() const { return ids_; }
    /// False only where nothing differs from the instant before.
    bool changed(const PixelRect& rect) const;
    const View& view() const { return *now_.view; }
    const std::vector<BallShare>& shares() const { return shares_; }
    /// Of threads beside the calling one, since construction.
    double others_cpu_s() const { return others_cpu_s_; }

  private:
    /// One picture with what belongs to it.
    struct Picture {
        std::shared_ptr<const View> view;
        std::shared_ptr<const SeenSurfaces> surfaces;
        std::unique_ptr<SeenBalls> balls;
        SeenScene seen() const { return {view.get(), surfaces.get(), balls.get()}; }
    };
    Picture picture_at(double t) const;
    void choose_tiles();
    void paint_tile(std::size_t tile);
    void paint_pixel(int x, int y, const Ray& ray, const Seen& seen);
    void write_flow(LayerKind kind, const std::optional<Picture>& other, int x, int y,
                    const Ray& ray, const Seen& seen);
    void measure_share(int ball);

    const Scene& scene_;
    const Motion& motion_;
    std::optional<BothRuns> both_;  ///< what the camera sees
    Camera camera_;
    bool moving_;
    int width_px_, height_px_;
    std::map<LayerKind, FloatImage> images_;
    bool wants_ids_ = false;
    std::vector<std::uint16_t> ids_;
    Picture now_;
    std::optional<Picture> next_, previous_;
    TileLists tiles_;                    ///< of the picture; their lists are not used
    std::vector<Seen> surfaces_seen_;    ///< by a camera that stands
    std::vector<bool> near_, was_near_;  ///< tiles: a ball is or was
    std::vector<bool> changed_;          ///< tiles
    bool first_ = true;
    std::optional<bool> had_next_, had_previous_;
    std::vector<std::atomic<std::int64_t>> visible_px_;
    std::vector<BallShare> shares_;
    double others_cpu_s_ = 0;
};

}  // namespace carom
