#include "render/picture/frame_passes.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "core/failure.h"
#include "render/blend/srgb.h"
#include "render/draw2d/style.h"

namespace carom {

namespace {

GhostLook ghost_look(const Scene& scene, const View& view) {
    constexpr double kGhostOutlinePx = 2.2;  // at 720
    const Ink ink = ghost_ink(scene.overlay.theme);
    return {{linear_from_srgb(ink.r), linear_from_srgb(ink.g), linear_from_srgb(ink.b)},
            std::max(1.2, overlay_px(kGhostOutlinePx, view.height_px()))};
}

/// Into the frame that is bound, without drawing: drivers compile a program when it is first used.
void draw_nothing(const Gl& gl) { gl.Viewport(0, 0, 0, 0); }

}  // namespace

FramePasses::FramePasses(DrawingContexts& contexts, const Contents& contents,
                         const PictureSetup& setup, const GlTexture& color)
    : contexts_(contexts),
      gl_(contexts.main.gl()),
      contents_(contents),
      setup_(setup),
      color_(color),
      frame_(make_framebuffer(gl_, "the picture", {&color})) {
    const Scene& scene = contents.scene;
    around_.occluded = setup.kind.occludes;
    around_.mirrored = wants_reflection(scene) && !scene.balls.empty() && !contents.transparent;
    if (contents.few_pictures) around_.programs = BallPrograms::kOneForAll;
    open_.push_back(&balls_);
    if (has_ghosts()) open_.push_back(&ghosts_);
}

FramePasses::~FramePasses() {
    if (!second_frame_) return;
    // Names of vertex arrays and framebuffers are those of their context; taking one never throws
    // after it has been taken before.
    try {
        contexts_.second->make_current();
        for (Shared* shared : {&balls_, &ghosts_})
            if (shared->in_second) shared->pass.reset();
        second_frame_ = GlFramebuffer();
        contexts_.main.make_current();
    } catch (const Failure&) {
    }
}

FramePasses::Shared* FramePasses::take_first() {
    const std::scoped_lock lock(taking_);
    if (open_.empty()) return nullptr;
    Shared* taken = open_.front();
    open_.pop_front();
    return taken;
}

FramePasses::Shared* FramePasses::take_last() {
    const std::scoped_lock lock(taking_);
    if (open_.empty()) return nullptr;
    Shared* taken = open_.back();
    // Balls and their mirror images have one program, and those are prepared with the shadows.
    if (taken == &balls_ && around_.mirrored) return nullptr;
    open_.pop_back();
    return taken;
}

void FramePasses::prepare(Shared& shared, const Gl& gl, const BackgroundPicture& background) {
    const View& view = setup_.view;
    const Lights& lights = setup_.lights;
    if (&shared == &ghosts_)
        shared.pass.emplace(gl, contents_.second->scene, view, lights, around_,
                            ghost_look(contents_.scene, view));
    else
        shared.pass.emplace(gl, contents_.scene, view, lights, around_);
    // Where the camera moves there is no background yet, and films have time.
    if (!setup_.moving) shared.pass->compile(background);
}

void FramePasses::prepare(const BackgroundPicture& background) {
    const Scene& scene = contents_.scene;
    const View& view = setup_.view;
    const Lights& lights = setup_.lights;
    const bool on_surfaces = setup_.moving ? !scene.surfaces.empty() : setup_.surfaces.count() > 0;
    if (on_surfaces && !scene.balls.empty())
        shadows_.emplace(gl_, scene, view, lights, around_.programs);
    if (around_.mirrored) reflections_.emplace(gl_, scene, view, lights, setup_.scale, around_);
    if (!setup_.moving) {
        gl_.BindFramebuffer(GL_FRAMEBUFFER, frame_.name());
        draw_nothing(gl_);
        // llvmpipe compiles again where a program before has bound a texture in a buffer's place:
        // in the order of a frame, from what one leaves behind.
        if (shadows_) shadows_->compile(background);
        if (reflections_) reflections_->compile(background, frame_);
    }
    while (Shared* shared = take_first()) prepare(*shared, gl_, background);
}

void FramePasses::prepare_in_second_context(const BackgroundPicture& background) {
    const Gl& gl = contexts_.second->gl();
    while (Shared* shared = take_last()) {
        if (!second_frame_) second_frame_ = make_framebuffer(gl, "the picture", {&color_});
        gl.BindFramebuffer(GL_FRAMEBUFFER, second_frame_.name());
        draw_nothing(gl);
        shared->in_second = true;
        prepare(*shared, gl, background);
    }
}

void FramePasses::set_view(const View& view, const Lights& lights, const PictureScale& scale) {
    for (Shared* shared : {&balls_, &ghosts_})
        if (shared->pass) shared->pass->set_view(view, lights);
    if (reflections_) reflections_->set_view(view, lights, scale);
}

void FramePasses::see_in_tiles(const View& view, const Lights& lights,
                               std::vector<TileBound> seen) {
    if (shadows_) shadows_->set_view(contents_.scene, view, lights, std::move(seen));
}

void FramePasses::draw_below(const DrawnBalls& bodies, const BackgroundPicture& background) {
    if (shadows_) shadows_->draw(bodies.balls, background);
    if (reflections_) reflections_->draw(bodies.balls, background, frame_, color_);
}

void FramePasses::draw_below_within(const TileMask& mask, const DrawnBalls& bodies,
                                    const BackgroundPicture& background) {
    if (shadows_) shadows_->draw_within(mask, background);
    if (reflections_) reflections_->draw(bodies.balls, background, frame_, color_);
}

TileMask FramePasses::looks_closely(const DrawnBalls& bodies, const View& view) const {
    TileMask tiles(view.width_px(), view.height_px(), ShadowTiles::kTilePx);
    if (setup_.kind.mirrors) tiles.add_all();
    if (shadows_) {
        const std::vector<float>& shaded = shadows_->tiles().tiles();
        for (std::size_t i = 0; i < shaded.size(); i += 4)
            tiles.add_tile(static_cast<int>(shaded[i]), static_cast<int>(shaded[i + 1]));
    }
    if (!setup_.kind.occludes) return tiles;
    for (const std::vector<BallInView>* balls : {&bodies.balls, &bodies.ghosts})
        for (const BallInView& ball : *balls)
            if (may_be_seen(ball, view)) tiles.add(bounds_in_picture(ball, view));
    return tiles;
}

void FramePasses::draw_balls(const DrawnBalls& bodies, const BackgroundPicture& background) {
    draw_in_its_context(balls_,
                        [&](BallBillboards& balls) { balls.draw(bodies.balls, background); });
    if (has_ghosts())
        draw_in_its_context(ghosts_, [&](BallBillboards& ghosts) {
            ghosts.draw_ghosts(bodies.ghosts, bodies.balls, background);
        });
}

void FramePasses::draw_in_its_context(Shared& shared,
                                      const std::function<void(BallBillboards&)>& draw) {
    if (!shared.in_second) {
        draw(*shared.pass);
        return;
    }
    // What one context has drawn another one sees when it is finished.
    gl_.Finish();
    contexts_.second->make_current();
    const Gl& gl = contexts_.second->gl();
    gl.BindFramebuffer(GL_FRAMEBUFFER, second_frame_.name());
    gl.Viewport(0, 0, setup_.view.width_px(), setup_.view.height_px());
    draw(*shared.pass);
    gl.Finish();
    gl.check("drawing balls");
    contexts_.main.make_current();
}

void FramePasses::mark(const DrawnBalls& bodies, const View& view, TileOwners& owners) {
    mark_balls(bodies.balls, 0, view, owners);
    mark_balls(bodies.ghosts, contents_.scene.balls.size(), view, owners);
    if (reflections_) mark_balls(reflections_->images(bodies.balls), 0, view, owners);
    if (shadows_) shadows_->mark(bodies.balls, owners);
}

}  // namespace carom
