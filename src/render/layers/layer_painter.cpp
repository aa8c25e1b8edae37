#include "render/layers/layer_painter.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/check.h"
#include "core/failure.h"
#include "core/in_parallel.h"
#include "render/layers/pixel_rays.h"
#include "render/view/camera_motion.h"

namespace carom {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

void write(float* to, const Vec3& value) {
    for (int i = 0; i < 3; ++i) to[i] = static_cast<float>(value[i]);
}

Ray ray_of(const View& view, int x, int y) { return pixel_ray(view, x + 0.5, y + 0.5); }

}  // namespace

LayerPainter::LayerPainter(const Scene& scene, const Motion& motion, const LayerSettings& settings)
    : scene_(scene),
      motion_(motion),
      both_(settings.second == nullptr ? std::nullopt
                                       : std::optional(both_runs(scene, motion, *settings.second))),
      camera_(choose_camera(both_ ? both_->scene : scene, both_ ? both_->motion : motion,
                            static_cast<double>(settings.width_px) / settings.height_px)),
      moving_(camera_moves(camera_)),
      width_px_(settings.width_px),
      height_px_(settings.height_px),
      tiles_(width_px_, height_px_),
      visible_px_(scene.balls.size()),
      shares_(scene.balls.size()) {
    for (const LayerKind kind : settings.kinds) {
        const auto channels = static_cast<int>(layer_kind_info(kind).channels.size());
        if (channels > 0) images_.emplace(kind, FloatImage(width_px_, height_px_, channels));
        wants_ids_ |= kind == LayerKind::kSegmentation;
    }
    const std::size_t pixels =
        static_cast<std::size_t>(width_px_) * static_cast<std::size_t>(height_px_);
    if (wants_ids_) ids_.resize(pixels);
    constexpr std::size_t kMostBodies = std::numeric_limits<std::uint16_t>::max();
    const std::size_t bodies = scene.balls.size() + scene.surfaces.size();
    if (wants_ids_ && bodies > kMostBodies)
        throw Failure(FailureKind::kInput,
                      fmt::format("--layers segmentation: the scene has {} balls and surfaces, and "
                                  "ids go up to {}",
                                  bodies, kMostBodies));
    if (!moving_) surfaces_seen_.resize(pixels);
}

LayerPainter::~LayerPainter() = default;

const FloatImage& LayerPainter::image(LayerKind kind) const { return images_.at(kind); }

LayerPainter::Picture LayerPainter::picture_at(double t) const {
    Picture picture;
    if (!moving_ && now_.view) {
        picture.view = now_.view;
        picture.surfaces = now_.surfaces;
    } else {
        picture.view =
            std::make_shared<View>(camera_at(camera_, motion_, t), width_px_, height_px_);
        picture.surfaces = std::make_shared<SeenSurfaces>(scene_, *picture.view);
    }
    picture.balls = std::make_unique<SeenBalls>(scene_, motion_, t, *picture.view);
    return picture;
}

void LayerPainter::paint(double t, const std::optional<double>& next,
                         const std::optional<double>& previous) {
    now_ = picture_at(t);
    next_.reset();
    previous_.reset();
    if (next && images_.contains(LayerKind::kFlow)) next_ = picture_at(*next);
    if (previous && images_.contains(LayerKind::kBackflow)) previous_ = picture_at(*previous);
    choose_tiles();
    had_next_ = next_.has_value();
    had_previous_ = previous_.has_value();
    for (auto& count : visible_px_) count = 0;
    others_cpu_s_ += in_parallel(tiles_.rows(), [this](int row) {
        const auto columns = static_cast<std::size_t>(tiles_.columns());
        for (std::size_t column = 0; column < columns; ++column) {
            const std::size_t tile = static_cast<std::size_t>(row) * columns + column;
            if (changed_[tile]) paint_tile(tile);
        }
    });
    first_ = false;
    others_cpu_s_ +=
        in_parallel(static_cast<int>(shares_.size()), [this](int ball) { measure_share(ball); });
}

void LayerPainter::choose_tiles() {
    // Flow from everywhere changes where a neighbouring frame comes or goes.
    const bool all = first_ || moving_ || had_next_ != next_.has_value() ||
                     had_previous_ != previous_.has_value();
    changed_.assign(tiles_.count(), all);
    near_.assign(tiles_.count(), false);
    was_near_.resize(tiles_.count());
    for (std::size_t tile = 0; tile < tiles_.count(); ++tile) {
        near_[tile] = now_.balls->any_near(tile) || (next_ && next_->balls->any_near(tile)) ||
                      (previous_ && previous_->balls->any_near(tile));
        if (near_[tile] || was_near_[tile]) changed_[tile] = true;
    }
    was_near_ = near_;
}

bool LayerPainter::changed(const PixelRect& rect) const {
    const PixelRect within = rect.common({0, 0, width_px_, height_px_});
    if (within.empty()) return false;
    constexpr int kTile = TileLists::kTilePx;
    for (int y = within.top / kTile; y <= (within.bottom - 1) / kTile; ++y)
        for (int x = within.left / kTile; x <= (within.right - 1) / kTile; ++x)
            if (changed_[tiles_.index_of(x * kTile, y * kTile)]) return true;
    return false;
}

void LayerPainter::paint_tile(std::size_t tile) {
    const PixelRect bounds = tiles_.bounds(tile);
    for (int y = bounds.top; y < bounds.bottom; ++y)
        for (int x = bounds.left; x < bounds.right; ++x) {
            const Ray ray = ray_of(*now_.view, x, y);
            Seen seen;
            if (moving_) {
                seen = now_.surfaces->nearest(ray, x, y);
            } else {
                Seen& kept = surfaces_seen_[static_cast<std::size_t>(y) *
                                                static_cast<std::size_t>(width_px_) +
                                            static_cast<std::size_t>(x)];
                if (first_) kept = now_.surfaces->nearest(ray, x, y);
                seen = kept;
            }
            seen = now_.balls->nearest(ray, x, y, seen);
            if (seen.body >= 0 && seen.body < now_.balls->count())
                visible_px_[static_cast<std::size_t>(seen.body)].fetch_add(
                    1, std::memory_order_relaxed);
            paint_pixel(x, y, ray, seen);
        }
}

void LayerPainter::paint_pixel(int x, int y, const Ray& ray, const Seen& seen) {
    const bool nothing = seen.body == Seen::kNothing;
    const bool is_ball = !nothing && seen.body < now_.balls->count();
    if (wants_ids_)
        ids_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px_) +
             static_cast<std::size_t>(x)] = static_cast<std::uint16_t>(seen.body + 1);
    for (auto& [kind, image] : images_) {
        float* to = image.at(x, y);
        switch (kind) {
            case LayerKind::kDepth:
                *to = static_cast<float>(seen.distance * ray.direction.dot(now_.view->forward()));
                break;
            case LayerKind::kDistance:
                *to = static_cast<float>(seen.distance);
                break;
            case LayerKind::kNormals:
                if (nothing)
                    write(to, Vec3::Zero());
                else if (is_ball)
                    write(to, (ray.at(seen.distance) - now_.balls->sphere(seen.body).center) /
                                  now_.balls->sphere(seen.body).radius);
                else
                    write(to, now_.surfaces->normal(seen.body - now_.balls->count(), ray));
                break;
            case LayerKind::kCoordinates:
                if (nothing)
                    write(to, Vec3(kNaN, kNaN, kNaN));
                else if (is_ball)
                    write(to, now_.balls->world_from_ball(seen.body).transpose() *
                                  (ray.at(seen.distance) - now_.balls->sphere(seen.body).center));
                else
                    write(to, ray.at(seen.distance));
                break;
            case LayerKind::kFlow:
                write_flow(kind, next_, x, y, ray, seen);
                break;
            case LayerKind::kBackflow:
                write_flow(kind, previous_, x, y, ray, seen);
                break;
            case LayerKind::kSegmentation:
                break;  // whole numbers, above
        }
    }
}

void LayerPainter::write_flow(LayerKind kind, const std::optional<Picture>& other, int x, int y,
                              const Ray& ray, const Seen& seen) {
    Flow flow{Vec2(kNaN, kNaN), true};
    if (other) flow = optical_flow(now_.seen(), other->seen(), ray, seen, Vec2(x + 0.5, y + 0.5));
    write(images_.at(kind).at(x, y), Vec3(flow.way.x(), flow.way.y(), flow.hidden ? 1 : 0));
}

void LayerPainter::measure_share(int ball) {
    BallShare& share = shares_[static_cast<std::size_t>(ball)];
    share = {};
    share.visible_px = visible_px_[static_cast<std::size_t>(ball)];
    const PixelRect& pixels = now_.balls->pixels(ball);
    const SphereShape& sphere = now_.balls->sphere(ball);
    for (int x = pixels.left; x < pixels.right; ++x) {
        // A sphere is convex, and so is what a picture shows of it.
        const auto met = [&](int y) {
            return first_hit(sphere, ray_of(*now_.view, x, y)).has_value();
        };
        BallShare::Run run{pixels.top, pixels.bottom};
        while (run.top < run.bottom && !met(run.top)) ++run.top;
        while (run.top < run.bottom && !met(run.bottom - 1)) --run.bottom;
        if (run.top >= run.bottom) {
            if (!share.runs.empty()) break;
            continue;
        }
        if (share.runs.empty()) share.left = x;
        share.runs.push_back(run);
        share.whole_px += run.bottom - run.top;
    }
}

}  // namespace carom
