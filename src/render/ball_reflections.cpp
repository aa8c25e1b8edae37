#include "render/ball_reflections.h"

#include <algorithm>
#include <cmath>

#include "render/surface_table.h"

namespace carom {

namespace {

GlProgram make_program(const Gl& gl, const View& view) {
    GlProgram::Sources sources;
    sources.name = "reflection";
    sources.vertex = assemble_shader({}, {"fullscreen_vertex"});
    sources.fragment = assemble_shader(view_defines(view), {"reflection_fragment"});
    sources.outputs = {"out_color"};
    return GlProgram(gl, sources);
}

Mirror plane_mirror(const PlaneShape& plane, const View& view) {
    Mirror mirror;
    mirror.normal = view_direction(view, plane.normal);
    mirror.offset = plane.offset_m - plane.normal.dot(view.eye());
    mirror.fades = true;
    return mirror;
}

Mirror box_mirror(const BoxShape& box, const PlaneShape& top, const View& view) {
    Mirror mirror = plane_mirror(top, view);
    mirror.fades = false;
    mirror.middle =
        view_point(view, box.center + top.normal * (top.offset_m - top.normal.dot(box.center)));
    const Mat3 axes = box.orientation.toRotationMatrix();
    Vec3* next = &mirror.axis_a;
    for (int i = 0; i < 3; ++i) {
        if (std::abs(axes.col(i).dot(top.normal)) > 0.5) continue;
        *next = view_direction(view, axes.col(i)) / (0.5 * box.size[i]);
        next = &mirror.axis_b;
    }
    return mirror;
}

}  // namespace

bool wants_reflection(const Scene& scene) {
    return std::any_of(scene.surfaces.begin(), scene.surfaces.end(), [&](const Surface& surface) {
        const bool flat = std::holds_alternative<PlaneShape>(surface.shape) ||
                          std::holds_alternative<BoxShape>(surface.shape);
        return flat && scene.looks.at(static_cast<std::size_t>(surface.look)).reflection > 0;
    });
}

std::vector<Mirror> find_mirrors(const Scene& scene, const View& view) {
    std::vector<Mirror> mirrors;
    for (const Surface& surface : scene.surfaces) {
        const double strength = scene.looks.at(static_cast<std::size_t>(surface.look)).reflection;
        if (!(strength > 0)) continue;
        if (const auto* plane = std::get_if<PlaneShape>(&surface.shape)) {
            if (!seen_from_front(*plane, view)) continue;
            mirrors.push_back(plane_mirror(*plane, view));
        } else if (const auto* box = std::get_if<BoxShape>(&surface.shape)) {
            const PlaneShape top = top_of(*box);
            if (!seen_from_front(top, view)) continue;
            mirrors.push_back(box_mirror(*box, top, view));
        } else {
            continue;
        }
        mirrors.back().strength = strength;
    }
    return mirrors;
}

std::vector<BallInView> mirror_images(const std::vector<BallInView>& balls, const Mirror& mirror,
                                      const View& view) {
    const Mat3 flip = Mat3::Identity() - 2 * mirror.normal * mirror.normal.transpose();
    std::vector<BallInView> images;
    for (const BallInView& ball : balls) {
        const double height = mirror.normal.dot(ball.center) - mirror.offset;
        if (height < -ball.radius) continue;  // all of it is behind the mirror
        BallInView& image = images.emplace_back(ball);
        image.center -= 2 * height * mirror.normal;
        image.ball_from_view = ball.ball_from_view * flip;
    }
    sort_for_drawing(images, view);
    return images;
}

BallReflections::BallReflections(const Gl& gl, const Scene& scene, const View& view,
                                 const Lights& lights, const PictureScale& scale,
                                 const BallSurroundings& around)
    : gl_(&gl),
      scene_(&scene),
      view_(view),
      lights_(lights),
      scale_(scale),
      mirrors_(find_mirrors(scene, view)),
      balls_(gl, scene, view, lights, around, std::nullopt, BallBillboards::Kind::kImages),
      layer_(make_texture(gl, GL_SRGB8_ALPHA8, view.width_px(), view.height_px(), GL_RGBA,
                          GL_UNSIGNED_BYTE)),
      layer_framebuffer_(make_framebuffer(gl, "mirror images", {&layer_})),
      program_(make_program(gl, view)),
      nothing_(gl) {
    set_view(view, lights, scale);
}

void BallReflections::set_view(const View& view, const Lights& lights, const PictureScale& scale) {
    view_ = view;
    lights_ = lights;
    scale_ = scale;
    mirrors_ = find_mirrors(*scene_, view);
    balls_.set_view(view, lights);
    set_common_uniforms(program_, view, lights);
    program_.set("u_facts", 0);
    program_.set("u_layer", 1);
    program_.set("u_mirror", 3);
}

std::vector<BallInView> BallReflections::images(const std::vector<BallInView>& balls) const {
    std::vector<BallInView> all;
    for (const Mirror& mirror : mirrors_)
        for (const BallInView& image : mirror_images(balls, mirror, view_))
            if (may_be_seen(image, view_)) all.push_back(image);
    return all;
}

std::vector<BallReflections::Part> BallReflections::parts_of(
    const std::vector<BallInView>& images) const {
    constexpr std::size_t kMostParts = 32;  // where many are, they lie together
    const Part whole{0, 0, view_.width_px(), view_.height_px()};
    std::vector<Part> parts;
    for (const BallInView& image : images) {
        if (!may_be_seen(image, view_)) continue;
        const Outline outline = project_sphere(image.center, image.radius, view_);
        if (!outline.is_ellipse) return {whole};
        const double x = std::hypot(outline.major.x(), outline.minor.x()) + 1;
        const double y = std::hypot(outline.major.y(), outline.minor.y()) + 1;
        const auto px = [](double at, int size) {
            return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(size)));
        };
        Part part{px(outline.center.x() - x, whole.right), px(outline.center.y() - y, whole.bottom),
                  px(outline.center.x() + x + 1, whole.right),
                  px(outline.center.y() + y + 1, whole.bottom)};
        // Joined with all that it overlaps, also those that it only then overlaps.
        for (std::size_t i = 0; i < parts.size();) {
            const Part& other = parts[i];
            const bool apart = part.left >= other.right || other.left >= part.right ||
                               part.top >= other.bottom || other.top >= part.bottom;
            if (apart && parts.size() < kMostParts) {
                ++i;
                continue;
            }
            part = {std::min(part.left, other.left), std::min(part.top, other.top),
                    std::max(part.right, other.right), std::max(part.bottom, other.bottom)};
            parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(i));
            i = 0;
        }
        if (part.left < part.right && part.top < part.bottom) parts.push_back(part);
    }
    return parts;
}

void BallReflections::draw(const std::vector<BallInView>& balls, const StaticPicture& background,
                           const GlFramebuffer& frame) {
    for (const Mirror& mirror : mirrors_) {
        const std::vector<BallInView> images = mirror_images(balls, mirror, view_);
        const std::vector<Part> parts = parts_of(images);
        if (parts.empty()) continue;
        gl_->BindFramebuffer(GL_FRAMEBUFFER, layer_framebuffer_.name());
        gl_->ClearColor(0, 0, 0, 0);
        gl_->Clear(GL_COLOR_BUFFER_BIT);
        balls_.set_mirror(mirror.normal, mirror.offset, lights_);
        balls_.draw(images, background);
        gl_->BindFramebuffer(GL_FRAMEBUFFER, frame.name());
        blend_layer(mirror, parts, background);
    }
}

void BallReflections::compile(const StaticPicture& background, const GlFramebuffer& frame) {
    if (mirrors_.empty()) return;
    gl_->BindFramebuffer(GL_FRAMEBUFFER, layer_framebuffer_.name());
    balls_.set_mirror(mirrors_.front().normal, mirrors_.front().offset, lights_);
    balls_.compile(background);
    compile_blending(background, frame);
}

void BallReflections::compile_blending(const StaticPicture& background,
                                       const GlFramebuffer& frame) {
    if (mirrors_.empty()) return;
    gl_->BindFramebuffer(GL_FRAMEBUFFER, frame.name());
    blend_layer(mirrors_.front(), {Part{0, 0, 0, 0}}, background);
    gl_->Viewport(0, 0, 0, 0);
}

void BallReflections::blend_layer(const Mirror& mirror, const std::vector<Part>& parts,
                                  const StaticPicture& background) {
    program_.set("u_normal", mirror.normal);
    program_.set("u_middle", mirror.middle);
    program_.set("u_axis_a", mirror.axis_a);
    program_.set("u_axis_b", mirror.axis_b);
    program_.set("u_offset", mirror.offset);
    program_.set("u_strength", mirror.strength);
    program_.set("u_fade_m", mirror.fades ? scale_.fade_m : 0.0);
    gl_->ActiveTexture(GL_TEXTURE0 + 3);
    gl_->BindTexture(GL_TEXTURE_2D, background.mirror().name());
    gl_->ActiveTexture(GL_TEXTURE1);
    gl_->BindTexture(GL_TEXTURE_2D, layer_.name());
    gl_->ActiveTexture(GL_TEXTURE0);
    gl_->BindTexture(GL_TEXTURE_2D, background.facts().name());
    gl_->BindVertexArray(nothing_.name());
    gl_->Enable(GL_BLEND);
    gl_->BlendFuncSeparate(GL_ONE, GL_ONE, GL_ZERO, GL_ONE);
    // First the sky goes that the images hide, then they come.
    for (const bool take_away : {true, false}) {
        program_.set("u_take_away", take_away ? 1 : 0);
        gl_->BlendEquationSeparate(take_away ? GL_FUNC_REVERSE_SUBTRACT : GL_FUNC_ADD, GL_FUNC_ADD);
        for (const Part& part : parts) {
            gl_->Viewport(part.left, part.top, part.right - part.left, part.bottom - part.top);
            gl_->DrawArrays(GL_TRIANGLES, 0, 3);
        }
    }
    gl_->Viewport(0, 0, view_.width_px(), view_.height_px());
}

}  // namespace carom
