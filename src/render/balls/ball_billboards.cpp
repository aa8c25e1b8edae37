#include "render/balls/ball_billboards.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "render/background/common_uniforms.h"
#include "render/balls/caster_cells.h"
#include "render/blend/srgb.h"
#include "render/view/view_space.h"

namespace carom {

namespace {

// One instance, in the order of the vertex shader's attributes (ball_vertex.glsl).
constexpr std::array<const char*, 12> kAttributes = {"a_bound",  "a_axes",    "a_ray",   "a_offset",
                                                     "a_row_x",  "a_row_y",   "a_row_z", "a_color",
                                                     "a_second", "a_contact", "a_sweep", "a_turn"};
constexpr std::size_t kInstanceFloats = 4 * kAttributes.size();
/// Of the quadrangle around a ball: more corners would leave out pixels beside the ball, but make
/// more inner edges, at which drivers shade pixels twice.
constexpr GLsizei kCorners = 4;
constexpr int kMostCasters = 8;  ///< balls that shade one ball; more would hardly be seen

/// The style that a look means on a ball: patterns of surfaces are none on a ball.
LookStyle ball_style(LookStyle style) {
    return style >= LookStyle::kChecker ? LookStyle::kPlain : style;
}

/// As ball_markings.glsl names the styles; nothing is painted on a plain ball.
constexpr std::array<const char*, 7> kStyleNames = {
    "PLAIN", "STRIPED", "BASKETBALL", "VOLLEYBALL", "FOOTBALL", "TENNIS", "TABLE_TENNIS"};

std::set<LookStyle> styles_in(const Scene& scene) {
    std::set<LookStyle> styles;
    for (const Ball& ball : scene.balls)
        styles.insert(ball_style(scene.looks.at(static_cast<std::size_t>(ball.look)).style));
    return styles;
}

struct ProgramKind {
    bool occluded, ghost, mirrored, casters, swept;
};

GlProgram link_program(const Gl& gl, const std::set<LookStyle>& styles, const View& view,
                       const ProgramKind& kind) {
    GlProgram::Sources sources;
    sources.name = "ball";
    std::vector<std::string> defines = view_defines(view);
    for (const LookStyle style : styles) {
        defines.push_back(kStyleNames.at(static_cast<std::size_t>(style)));
        sources.name += fmt::format(", style {}", static_cast<int>(style));
    }
    if (styles.size() > 1) defines.push_back("SEVERAL_STYLES");
    if (kind.occluded) defines.push_back("OCCLUDED");
    if (kind.ghost) defines.push_back("GHOST");
    if (kind.mirrored) defines.push_back("MIRRORED");
    if (!kind.casters) defines.push_back("NO_CASTERS");
    if (kind.swept) defines.push_back("SWEPT");
    sources.vertex = assemble_shader(defines, {"ball_vertex"});
    sources.fragment = assemble_shader(defines, {"ball_markings", "ball_fragment"});
    sources.attributes.assign(kAttributes.begin(), kAttributes.end());
    sources.outputs = {"out_color"};
    return GlProgram(gl, sources);
}

void put(std::vector<float>& out, const Vec3& xyz, double w) {
    for (int i = 0; i < 3; ++i) out.push_back(static_cast<float>(xyz[i]));
    out.push_back(static_cast<float>(w));
}

void put(std::vector<float>& out, const Vec2& xy, const Vec2& zw) {
    put(out, Vec3(xy.x(), xy.y(), zw.x()), zw.y());
}

}  // namespace

BallBillboards::BallBillboards(const Gl& gl, const Scene& scene, const View& view,
                               const Lights& lights, const BallSurroundings& around,
                               const std::optional<GhostLook>& ghost, Kind kind)
    : gl_(&gl),
      scene_(&scene),
      view_(view),
      surface_shade_(scene, view, lights),
      lights_(lights),
      to_light_(view_direction(view, lights.to_light)),
      light_tan_(lights.tan_radius),
      images_(kind == Kind::kImages),
      ghost_(ghost),
      for_all_(around.programs == BallPrograms::kOneForAll),
      vertex_array_(gl),
      instance_buffer_(gl),
      caster_array_(gl) {
    const bool both = for_all_ && !ghost;
    with_static_ = around.occluded && (both || !images_);
    with_mirrors_ = around.mirrored && (both || images_);
    // Those of balls that are shaded by others are made when there is one.
    for (const LookStyle style : styles_in(scene)) program_of({style, false, false});
    gl.BindVertexArray(vertex_array_.name());
    for (GLuint i = 0; i < kAttributes.size(); ++i) {
        gl.EnableVertexAttribArray(i);
        gl.VertexAttribDivisor(i, 1);
    }
    gl.check("preparing the balls");
}

GlProgram& BallBillboards::make_program(const ProgramKey& key) {
    GlProgram program =
        link_program(*gl_, for_all_ ? styles_in(*scene_) : std::set<LookStyle>{key.style}, view_,
                     {with_static_, ghost_.has_value(), with_mirrors_, key.casters, key.swept});
    set_common_uniforms(program, view_, lights_);
    if (ghost_) {
        program.set("u_ghost", ghost_->color);
        program.set("u_outline", ghost_->outline_px);
    }
    program.set("u_size", Vec2(view_.width_px(), view_.height_px()));
    program.set("u_g_buffer", 0);
    program.set("u_front", 1);
    program.set("u_mirror", 3);
    program.set("u_casters", 2);
    program.set("u_is_image", images_ ? 1 : 0);
    if (mirror_) set_mirror_uniforms(program);
    return programs_.emplace(key, std::move(program)).first->second;
}

GlProgram& BallBillboards::program_of(ProgramKey key) {
    if (for_all_) key = {LookStyle::kPlain, true, key.swept};
    if (ghost_) key.casters = true;  // which of ghosts are solid balls
    const auto found = programs_.find(key);
    return found != programs_.end() ? found->second : make_program(key);
}

void BallBillboards::set_view(const View& view, const Lights& lights) {
    view_ = view;
    lights_ = lights;
    surface_shade_ = SurfaceShade(*scene_, view, lights);
    mirror_.reset();
    to_light_ = view_direction(view, lights.to_light);
    for (auto& [kind, program] : programs_) set_common_uniforms(program, view, lights);
}

void BallBillboards::set_mirror(const Vec3& normal, double offset, const Lights& lights) {
    mirror_ = MirrorPlane{normal, offset};
    lights_ = lights;
    to_light_ = mirror_->flipped(view_direction(view_, lights.to_light));
    for (auto& [kind, program] : programs_) set_mirror_uniforms(program);
}

void BallBillboards::set_mirror_uniforms(GlProgram& program) const {
    program.set("u_mirror_normal", mirror_->normal);
    program.set("u_mirror_offset", mirror_->offset);
    program.set("u_up", mirror_->flipped(view_direction(view_, Vec3::UnitZ())));
    program.set("u_light", to_light_);
}

BallShade BallBillboards::shade_on(const BallInView& ball) const {
    if (!mirror_) return surface_shade_.on(ball);
    const Vec3& normal = mirror_->normal;
    BallInView original = ball;
    original.center -= 2 * (normal.dot(ball.center) - mirror_->offset) * normal;
    BallShade shade = surface_shade_.on(original);
    shade.contact -= 2 * normal.dot(shade.contact) * normal;
    return shade;
}

LookStyle BallBillboards::style_of(const BallInView& ball) const {
    return ball_style(scene_->looks[static_cast<std::size_t>(ball.look)].style);
}

BallBillboards::Casters BallBillboards::find_casters(const std::vector<BallInView>& balls) const {
    Casters casters;
    const CasterCells cells(balls, to_light_);
    for (const BallInView& ball : balls) {
        const int first = static_cast<int>(casters.vec4s.size() / 4);
        int count = 0;
        if (!ball.drawn) {
            casters.first.push_back(first);
            casters.count.push_back(count);
            continue;
        }
        for (const int number : cells.near(ball)) {
            const BallInView& other = balls[static_cast<std::size_t>(number)];
            if (&other == &ball || other.instant != ball.instant) continue;
            if (!may_shade(other, ball, to_light_, light_tan_)) continue;
            put(casters.vec4s, (other.center - ball.center) / ball.radius,
                other.radius / ball.radius);
            if (++count == kMostCasters) break;
        }
        casters.first.push_back(first);
        casters.count.push_back(count);
    }
    return casters;
}

BallBillboards::Casters BallBillboards::find_hiders(const std::vector<BallInView>& ghosts,
                                                    const std::vector<BallInView>& solid) const {
    Casters hiders;
    for (const BallInView& ghost : ghosts) {
        const int first = static_cast<int>(hiders.vec4s.size() / 4);
        int count = 0;
        const Outline outline = project_sphere(ghost.center, ghost.radius, view_);
        for (const BallInView& other : solid) {
            // Apart in the picture, or behind the ghost, a ball hides nothing of it.
            const Outline over = project_sphere(other.center, other.radius, view_);
            constexpr double kSoft = 3;  // px of soft edges
            const double reach = outline.major.norm() + over.major.norm() + kSoft;
            if (outline.is_ellipse && over.is_ellipse &&
                (outline.center - over.center).norm() > reach)
                continue;
            if (other.center.norm() - other.radius > ghost.center.norm() + ghost.radius) continue;
            put(hiders.vec4s, (other.center - ghost.center) / ghost.radius,
                other.radius / ghost.radius);
            ++count;
        }
        hiders.first.push_back(first);
        hiders.count.push_back(count);
    }
    return hiders;
}

void BallBillboards::append_instance(const BallInView& ball, const BallShade& shade,
                                     int first_caster, int casters) {
    const Bound bound = bound_around(ball);
    // The centre as depth * (ray through a pixel) + rest, so that the shader works with the small
    // difference of two rays instead of with large coordinates.
    const Vec2 size(view_.width_px(), view_.height_px());
    const bool ahead = bound.around_ellipse;
    const double depth = ahead ? ball.center.z() : 0.0;
    const Vec2 reference = ahead ? view_pixel(view_, ball.center) : Vec2(0.5 * size);
    const Vec3 rest = ahead ? Vec3(Vec3::Zero()) : ball.center;
    const Look& look = scene_->looks[static_cast<std::size_t>(ball.look)];

    put(instances_, bound.middle, Vec2(first_caster, casters));
    put(instances_, bound.major, bound.minor);
    put(instances_, reference, Vec2(depth / ball.radius, ball.radius));
    put(instances_, rest / ball.radius, 0);
    for (int row = 0; row < 3; ++row)
        put(instances_, ball.ball_from_view.row(row).transpose(), row == 0 ? shade.key : 0.0);
    put(instances_, linear_light(look.color), static_cast<double>(ball_style(look.style)));
    put(instances_, linear_light(look.second_color), 0);
    put(instances_, shade.contact, shade.contact_strength);
    put(instances_, ball.sweep / ball.radius, bound.half_way.x());
    put(instances_, ball.turn, bound.half_way.y());
}

/// Around the ball's outline, and a pixel for the soft edge; of a ball that is swept drawn out
/// along its way, so that it holds the outlines from where it begins to where it ends.
BallBillboards::Bound BallBillboards::bound_around(const BallInView& ball) const {
    const Vec2 size(view_.width_px(), view_.height_px());
    const Bound whole{false, 0.5 * size, {size.x(), 0}, {0, size.y()}, Vec2::Zero()};
    if (!ball.swept) {
        const Outline outline = project_sphere(ball.center, ball.radius, view_);
        if (!outline.is_ellipse) return whole;
        return {true, outline.center, outline.major + outline.major.normalized(),
                outline.minor + outline.minor.normalized(), Vec2::Zero()};
    }
    const Outline from = project_sphere(swept_from(ball), ball.radius, view_);
    const Outline to = project_sphere(swept_to(ball), ball.radius, view_);
    if (!from.is_ellipse || !to.is_ellipse) return whole;
    const Vec2 half_way = 0.5 * (to.center - from.center);
    double reach = 0;
    for (const Outline* outline : {&from, &to})
        reach = std::max({reach, outline->major.norm(), outline->minor.norm()});
    reach += 1;
    const Vec2 along = half_way.norm() > 1e-9 ? Vec2(half_way.normalized()) : Vec2(1, 0);
    return {true, 0.5 * (from.center + to.center), reach * along,
            reach * Vec2(-along.y(), along.x()), half_way};
}

void BallBillboards::draw(const std::vector<BallInView>& balls,
                          const BackgroundPicture& background) {
    draw_instances(balls, find_casters(balls), background);
}

void BallBillboards::draw_ghosts(const std::vector<BallInView>& ghosts,
                                 const std::vector<BallInView>& solid,
                                 const BackgroundPicture& background) {
    draw_instances(ghosts, find_hiders(ghosts, solid), background);
}

void BallBillboards::draw_instances(const std::vector<BallInView>& balls, const Casters& casters,
                                    const BackgroundPicture& background) {
    instances_.clear();
    std::vector<GlProgram*> programs;  // of the balls that may be seen
    for (std::size_t i = 0; i < balls.size(); ++i) {
        if (!may_be_seen(balls[i], view_)) continue;
        append_instance(balls[i], shade_on(balls[i]), casters.first[i], casters.count[i]);
        programs.push_back(&program_of({style_of(balls[i]), casters.count[i] > 0, balls[i].swept}));
    }
    if (!programs.empty()) draw_runs(programs, casters.vec4s, background);
}

void BallBillboards::compile(const BackgroundPicture& background) {
    std::vector<GlProgram*> programs;
    for (auto& [kind, program] : programs_) programs.push_back(&program);
    instances_.assign(programs.size() * kInstanceFloats, 0.0F);
    draw_runs(programs, {}, background);
}

void BallBillboards::draw_runs(const std::vector<GlProgram*>& programs,
                               const std::vector<float>& casters,
                               const BackgroundPicture& background) {
    caster_array_.upload(casters);
    caster_array_.bind(2);
    if (with_static_) {
        gl_->ActiveTexture(GL_TEXTURE1);
        gl_->BindTexture(GL_TEXTURE_2D, background.front().name());
        gl_->ActiveTexture(GL_TEXTURE0);
        gl_->BindTexture(GL_TEXTURE_2D, background.g_buffer().name());
    }
    if (with_mirrors_) {
        gl_->ActiveTexture(GL_TEXTURE3);
        gl_->BindTexture(GL_TEXTURE_2D, background.mirror().name());
    }
    gl_->BindVertexArray(vertex_array_.name());
    gl_->BindBuffer(GL_ARRAY_BUFFER, instance_buffer_.name());
    gl_->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(instances_.size() * sizeof(float)),
                    instances_.data(), GL_STREAM_DRAW);
    gl_->Enable(GL_BLEND);
    gl_->BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);

    // One call per run of equal programs: the order from far to near must stay.
    constexpr std::size_t kStride = kInstanceFloats * sizeof(float);
    for (std::size_t begin = 0; begin < programs.size();) {
        std::size_t end = begin + 1;
        while (end < programs.size() && programs[end] == programs[begin]) ++end;
        programs[begin]->use();
        for (GLuint i = 0; i < kAttributes.size(); ++i) {
            const std::size_t offset = begin * kStride + std::size_t{i} * 4 * sizeof(float);
            gl_->VertexAttribPointer(i, 4, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(kStride),
                                     reinterpret_cast<const void*>(offset));
        }
        gl_->DrawArraysInstanced(GL_TRIANGLE_FAN, 0, kCorners, static_cast<GLsizei>(end - begin));
        begin = end;
    }
}

}  // namespace carom
