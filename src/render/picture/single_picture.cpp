#include "render/picture/single_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "core/check.h"
#include "core/failure.h"
#include "render/background/background_drawing.h"
#include "render/background/background_picture.h"
#include "render/background/surface_table.h"
#include "render/balls/drawn_balls.h"
#include "render/balls/shadow_tiles.h"
#include "render/blend/alpha_encoding.h"
#include "render/blend/picture_mean.h"
#include "render/gl/driver_clock.h"
#include "render/gl/offscreen.h"
#include "render/overlay/elements.h"
#include "render/picture/exposure_groups.h"
#include "render/picture/frame_changes.h"
#include "render/picture/frame_passes.h"
#include "render/picture/moving_layer.h"
#include "render/picture/picture_setup.h"
#include "render/picture/picture_target.h"
#include "render/runs/second_run.h"
#include "render/view/camera_motion.h"
#include "render/view/exposure.h"
#include "render/view/picture_scale.h"

namespace carom {

namespace {

/// Runs `work` on a thread of its own; where there is none to be had, when its result is asked for.
template <class Work>
std::future<double> on_a_thread(const Work& work) {
    try {
        return std::async(std::launch::async, work);
    } catch (const std::system_error&) {
        return std::async(std::launch::deferred, work);
    }
}

class SinglePicture : public Picture {
  public:
    SinglePicture(const Scene& scene, const Motion& motion, const PainterOptions& options,
                  const PictureHalf* half)
        : scene_(scene),
          motion_(motion),
          second_(options.second),
          half_(half),
          transparent_(scene.background == Background::kTransparent),
          width_px_(options.width_px),
          height_px_(options.height_px),
          setup_(scene, motion, options, half),
          draw_cpu_s_(thread_cpu_s() - begin_s_),
          contexts_(options.contexts ? options.contexts : std::make_shared<DrawingContexts>()),
          context_(contexts_->main),
          gl_(context_.gl()) {
        context_.make_current();
        target_.emplace(context_, width_px_, height_px_);
        const double begin = clock_.now_s();
        // Of a camera that stands, the background takes about as long as everything else: it is
        // drawn meanwhile. (An exception here breaks the promise, so that the thread ends.)
        std::future<double> drawn;
        std::promise<const BackgroundPicture*> empty;
        if (!setup_.moving)
            drawn = on_a_thread([this, &options, promised = empty.get_future().share()] {
                return draw_in_second_context(
                    *contexts_,
                    {setup_.view, setup_.lights, setup_.surfaces, setup_.scale, setup_.kind},
                    promised, shares(options));
            });

        gl_.Disable(GL_DITHER);
        gl_.PixelStorei(GL_PACK_ALIGNMENT, 4);
        gl_.Enable(GL_FRAMEBUFFER_SRGB);
        target_->make_color();
        // Under a camera that moves nothing of a background stays: the frame itself is its picture.
        background_.emplace(gl_, width_px_, height_px_, setup_.kind,
                            setup_.moving ? &target_->color() : nullptr);
        passes_.emplace(*contexts_,
                        FramePasses::Contents{scene, second_, transparent_, options.few_pictures},
                        setup_, target_->color());
        empty.set_value(&*background_);
        if (setup_.moving)
            drawing_.emplace(gl_, setup_.kind, BackgroundPrograms::kEachSetOfBodies)
                .aim(*background_);
        const Image layer = setup_.moving ? Image() : setup_.overlay.background_layer();
        if (scene.film.shutter_deg > 0) mean_.emplace();
        passes_->prepare(*background_);
        if (!setup_.moving) {
            draw_cpu_s_ += drawn.get();
            context_.make_current();  // another one was, if the thread was this one
            if (layer.width_px != 0) background_->lay_over(layer);
            // For a few pictures it is not worth the while to find out.
            if (passes_->has_shadows() && !options.few_pictures)
                passes_->see_in_tiles(setup_.view, setup_.lights, seen_in_tiles());
            target_->check_not_blank(transparent_, *background_, passes_->frame());
            if (!options.few_pictures)
                changes_.emplace(setup_.view, setup_.lights, scene.balls.size());
        }
        gl_.check("preparing the picture");
        draw_cpu_s_ += clock_.now_s() - begin;
    }

    ~SinglePicture() override {
        // The objects below are deleted in this context; destroying a context never throws.
        try {
            context_.make_current();
        } catch (const Failure&) {
        }
    }
    SinglePicture(const SinglePicture&) = delete;
    SinglePicture& operator=(const SinglePicture&) = delete;

    void paint(const std::vector<double>& instants, Image& out) override {
        CAROM_CHECK(instants.size(), >, std::size_t{0});
        const double t = instants.back();
        const double begin = clock_.now_s();
        context_.make_current();
        if (out.width_px != width_px_ || out.height_px != height_px_)
            out = Image(width_px_, height_px_);
        if (changes_) changes_->forget();
        if (!setup_.moving) layer_.update(t);
        const bool blurred = mean_ && instants.size() == 1 && sum_exposure(t);
        if (setup_.moving)
            draw_moved(t, instants, t);
        else
            draw_picture(drawn_balls_at(instants), {target_->whole()});
        gl_.Finish();
        const double drawn = clock_.now_s();
        target_->read({target_->whole()}, passes_->frame(), out);
        const double read = clock_.now_s();
        if (blurred) mean_->write(out);
        if (transparent_) encode_alpha(out);
        setup_.overlay.draw_over(t, out);
        draw_cpu_s_ += drawn - begin + (clock_.now_s() - read);
        read_cpu_s_ += read - drawn;
    }

    ChangedParts paint_next(double t, Image& picture) override {
        const bool kept = picture.width_px == width_px_ && picture.height_px == height_px_ &&
                          picture.bgra.data() == kept_pixels_;
        if (!changes_) {
            paint({t}, picture);
            return {};
        }
        if (!kept) {
            changes_->forget();
            setup_.overlay.forget_over();
            if (picture.width_px != width_px_ || picture.height_px != height_px_)
                picture = Image(width_px_, height_px_);
            kept_pixels_ = picture.bgra.data();
        }
        const double begin = clock_.now_s();
        context_.make_current();
        std::vector<PixelRect> others = blurred_;
        if (const PixelRect changed = layer_.update(t); !changed.empty()) others.push_back(changed);
        const bool blurred = mean_ && sum_exposure(t);
        others.insert(others.end(), blurred_.begin(), blurred_.end());
        DrawnBalls bodies = drawn_balls_at({t});
        const ShadowTiles* shadows = passes_->cast(bodies);
        const std::vector<BallInView> images = passes_->images(bodies);
        changes_->update(bodies, images, shadows, others);
        TileMask tiles = changes_->tiles();
        if (!tiles.empty()) {
            target_->restore(changes_->rects(), *background_, passes_->frame());
            passes_->draw_below_within(tiles, bodies, *background_);
            layer_.lay_over(changes_->rects(), passes_->frame(), target_->color());
            passes_->draw_balls(bodies, *background_);
            gl_.Finish();
        }
        setup_.overlay.find_changes_over(t, tiles);
        const std::vector<PixelRect> parts = tiles.rects();
        const double drawn = clock_.now_s();
        // Where all of it is drawn anew it would take longer to find what has stayed by chance.
        const bool finds_parts = kept && tiles.share() < 1;
        if (finds_parts) target_->keep(parts, picture);
        target_->read(parts, passes_->frame(), picture);
        const double read = clock_.now_s();
        if (blurred) mean_->write(picture);
        if (transparent_)
            for (const PixelRect& part : parts) encode_alpha(picture, part);
        setup_.overlay.redraw_over(t, picture);
        draw_cpu_s_ += drawn - begin + (clock_.now_s() - read);
        read_cpu_s_ += read - drawn;
        return finds_parts ? ChangedParts::only(target_->differing(parts, picture))
                           : ChangedParts{};
    }

    bool draws_each_anew() const override { return !changes_; }

    std::string renderer() override {
        context_.make_current();
        return context_.renderer();
    }
    std::map<std::string, DrawnEffect> effects() const override;
    double draw_cpu_s() const override { return draw_cpu_s_; }
    double read_cpu_s() const override { return read_cpu_s_; }

  private:
    /// What the thread that draws the background does next: where this is the one picture that
    /// is drawn, programs are compiled by both threads.
    std::function<void(const BackgroundPicture&)> shares(const PainterOptions& options) {
        if (!options.few_pictures || options.contexts) return {};
        return
            [this](const BackgroundPicture& drawn) { passes_->prepare_in_second_context(drawn); };
    }

    std::vector<TileBound> seen_in_tiles() const {
        if (!setup_.kind.occludes) return {};  // on one plane the shadows' own bounds are tight
        return background_->tile_bounds(setup_.view, ShadowTiles::kTilePx);
    }

    /// Everything below the text, and the view, for the camera's place at t; the balls are those of
    /// `instants`, what lies below them that of `layer_t`.
    void draw_moved(double t, const std::vector<double>& instants, double layer_t) {
        const Camera camera = camera_at(setup_.camera, camera_motion(), t);
        const Lights& lights = setup_.lights;
        const View& view = setup_.view = View(camera, width_px_, height_px_);
        setup_.surfaces = make_surface_table(scene_, view);
        setup_.scale = scale_of(scene_, camera);
        passes_->see_in_tiles(view, lights, {});
        passes_->set_view(view, lights, setup_.scale);
        const DrawnBalls bodies = drawn_balls_at(instants);
        passes_->cast(bodies);
        const TileMask close = passes_->looks_closely(bodies, view);
        if (!target_->checked()) target_->expect_drawing(transparent_, passes_->frame());
        drawing_->draw(view, lights, setup_.surfaces, setup_.scale,
                       sort_into_tiles(setup_.surfaces, view, lights, setup_.scale), &close);
        if (!target_->checked()) target_->check_drawn(transparent_, passes_->frame());
        setup_.overlay.set_view(view);
        lay_background_layer();
        target_->aim(passes_->frame());
        passes_->draw_below_within(close, bodies, *background_);
        layer_.update(layer_t);  // the view is another one
        layer_.lay_over({target_->whole()}, passes_->frame(), target_->color());
        passes_->draw_balls(bodies, *background_);
    }

    const Motion& camera_motion() const {
        return half_ != nullptr ? *half_->camera_motion : motion_;
    }

    DrawnBalls drawn_balls_at(const std::vector<double>& instants) const {
        return carom::drawn_balls_at(instants, scene_, motion_, second_, setup_.view);
    }

    /// Everything below the text under a camera that stands; of the background, what `parts` cover.
    void draw_picture(const DrawnBalls& bodies, const std::vector<PixelRect>& parts) {
        target_->restore(parts, *background_, passes_->frame());
        passes_->draw_below(bodies, *background_);
        layer_.lay_over(parts, passes_->frame(), target_->color());
        passes_->draw_balls(bodies, *background_);
    }

    DrawnBalls balls_during(const OpenTime& open) const {
        return carom::drawn_balls_during(open, scene_, motion_, second_, setup_.view);
    }

    static OpenTime open_part(const Exposure& exposure, int i, int count) {
        return {exposure.at(static_cast<double>(i) / count), exposure.at((i + 0.5) / count),
                exposure.at((i + 1.0) / count)};
    }

    /// In how many parts of the time a group is drawn: few, as long as ways are lines within them.
    int sweeps_of(const ExposureGroup& group, const Exposure& exposure) const {
        constexpr double kStraightPx = 0.35;
        const int few = sweep_count(group.count);
        for (int i = 0; i < few; ++i) {
            const OpenTime open = open_part(exposure, i, few);
            if (bends_px(open, motion_, setup_.view, group.bodies, 0) > kStraightPx ||
                (second_ != nullptr && bends_px(open, second_->motion, setup_.view, group.bodies,
                                                scene_.balls.size()) > kStraightPx))
                return group.count;
        }
        return few;
    }

    /// What blurs in the picture at t, while the shutter is open.
    struct Blur {
        Exposure exposure;
        std::vector<double> ways_px;  ///< of the balls, then of those of the second run
        int count = 1;                ///< of instants, at most
    };
    Blur blur_at(double t) const {
        Blur blur{Exposure(scene_.film, motion_.duration, t), {}};
        // Balls are seen from where the camera is at t.
        const View view(camera_at(setup_.camera, camera_motion(), t), width_px_, height_px_);
        std::vector<BallWay> ways = ball_ways_px(scene_, motion_, blur.exposure, view);
        if (second_ != nullptr) {
            const std::vector<BallWay> seconds =
                ball_ways_px(second_->scene, second_->motion, blur.exposure, view);
            ways.insert(ways.end(), seconds.begin(), seconds.end());
        }
        double longest = 0;
        for (const BallWay& way : ways) longest = std::max(longest, way.seen);
        for (const BallWay& way : ways) blur.ways_px.push_back(std::min(way.all, longest));
        if (setup_.moving)
            longest +=
                camera_way_px(setup_.camera, camera_motion(), blur.exposure, width_px_, height_px_);
        blur.count = exposure_count(longest);
        return blur;
    }

    static_assert(kMostInstants <= PictureMean::kMost);
    /// Sums pictures wherever something moves; false where nothing does. Trails and the like are
    /// those of t.
    bool sum_exposure(double t) {
        blurred_.clear();
        const Blur blur = blur_at(t);
        most_instants_ = std::max(most_instants_, blur.count);
        if (blur.count < 2) return false;
        mean_->clear();
        if (setup_.moving) {
            TileMask mask(width_px_, height_px_, ShadowTiles::kTilePx);
            mask.add_all();
            mean_->begin(mask.parts(), blur.count);
            for (const double instant : exposure_instants(blur.exposure, blur.count)) {
                draw_moved(instant, {instant}, t);
                mean_->add(gl_, passes_->frame());
            }
            return true;
        }
        TileOwners owners(width_px_, height_px_, ShadowTiles::kTilePx, blur.ways_px.size());
        // Lines that a way bends away from would not mark all that is drawn.
        ExposureGroup all;
        all.count = blur.count;
        all.bodies.assign(blur.ways_px.size(), true);
        const int marked = sweeps_of(all, blur.exposure);
        for (int i = 0; i < marked; ++i)
            passes_->mark(balls_during(open_part(blur.exposure, i, marked)), setup_.view, owners);
        for (const ExposureGroup& group : sort_exposure(owners, blur.ways_px, blur.count)) {
            std::vector<PixelRect> changing;
            for (const TileMask::Part& part : group.parts) changing.push_back(part.bounds);
            changing = apart(changing);
            blurred_.insert(blurred_.end(), changing.begin(), changing.end());
            const int count = sweeps_of(group, blur.exposure);
            mean_->begin(group.parts, count);
            for (int i = 0; i < count; ++i) {
                DrawnBalls bodies = balls_during(open_part(blur.exposure, i, count));
                draw_only(group, scene_.balls.size(), bodies);
                draw_picture(bodies, changing);
                mean_->add(gl_, passes_->frame());
            }
        }
        return true;
    }

    void lay_background_layer() {
        const Image layer = setup_.overlay.background_layer();
        if (layer.width_px != 0) background_->lay_over(layer);
    }

    const Scene& scene_;
    const Motion& motion_;
    const SecondRun* second_;  ///< drawn as ghosts; may be null
    const PictureHalf* half_;  ///< null where this is the whole picture
    bool transparent_;
    int width_px_, height_px_;
    double begin_s_ = thread_cpu_s();
    PictureSetup setup_;  // as its driver is loaded meanwhile, before the context
    double draw_cpu_s_;
    std::shared_ptr<DrawingContexts> contexts_;
    OffscreenContext& context_;  // outlives every owner of GL objects below
    const Gl& gl_;
    DriverClock clock_;
    std::optional<PictureTarget> target_;
    std::optional<BackgroundPicture> background_;
    std::optional<BackgroundDrawing> drawing_;  ///< again and again, where the camera moves
    std::optional<FramePasses> passes_;
    MovingLayer layer_{gl_, setup_.overlay, setup_.moving};
    std::optional<FrameChanges> changes_;        ///< where the camera stands, of a film
    const std::uint8_t* kept_pixels_ = nullptr;  ///< of the picture that paint_next() goes on with
    std::vector<PixelRect> blurred_;             ///< what was averaged in it, and around
    std::optional<PictureMean> mean_;            ///< where there is a shutter
    int most_instants_ = 1;                      ///< of one picture
    double read_cpu_s_ = 0;
};

std::map<std::string, DrawnEffect> SinglePicture::effects() const {
    std::map<std::string, DrawnEffect> result;
    const auto add = [&](const char* name, bool on, const char* why_on, const char* why_off) {
        result[name] = {on, on ? why_on : why_off};
    };
    bool marked = false;
    for (const Ball& ball : scene_.balls)
        marked |= scene_.looks[static_cast<std::size_t>(ball.look)].style != LookStyle::kPlain;
    add("shadows", passes_->has_shadows(), "balls over surfaces", "no ball, or no surface in view");
    add("reflection", passes_->has_reflections(), "a look with a reflection",
        transparent_ ? "not on a transparent background" : "no look asks for it");
    add("occlusion", setup_.kind.occludes, "bodies that balls can pass behind",
        "nothing that a ball could pass behind");
    add("markings", marked, "balls with a style", "all balls are plain");
    for (const ElementKind& kind : element_kinds())
        if (kind.name != nullptr) add(kind.name, kind.wanted(scene_), kind.why, kind.why_not);
    add("transparent", transparent_, "the scene asks for it", "not asked for");
    for (const std::string& name : setup_.overlay.left_out())
        result[name] = {false, "the picture has no room for it"};
    add("against", passes_->has_ghosts(), "a second run as ghosts", "no second run");
    add("motion_blur", mean_.has_value(), "film.shutter_deg is above 0", "film.shutter_deg is 0");
    if (mean_)
        result["motion_blur"].why += fmt::format("; at most {} instants a picture", most_instants_);
    return result;
}

}  // namespace

std::unique_ptr<Picture> make_single_picture(const Scene& scene, const Motion& motion,
                                             const PainterOptions& options,
                                             const PictureHalf* half) {
    return std::make_unique<SinglePicture>(scene, motion, options, half);
}

}  // namespace carom
