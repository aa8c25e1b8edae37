#include "render/background/background_drawing.h"

#include <algorithm>
#include <array>
#include <utility>

#include "render/background/common_uniforms.h"
#include "render/background/plane_tiles.h"
#include "render/gl/driver_clock.h"

namespace carom {

namespace {

constexpr const char* kManyPlanes = "MANY_PLANES";  // they are listed

/// Edges are where there is just anything.
bool has_front(const BackgroundKind& kind, const PartKind& part) {
    return kind.occludes && part.seen == PartView::kAny;
}

/// Patterns of all surfaces, or of the one plane.
std::vector<std::string> pattern_defines(const SurfaceTable& table, const PartKind& part) {
    std::vector<std::string> defines;
    const bool one = part.seen != PartView::kAny;
    if (one && table.planes == 0) return defines;
    const double style = one ? table.at(0, 4).w() : 0;
    const auto add = [&](bool has, double number, const char* name) {
        if (has && (!one || style == number)) defines.emplace_back(name);
    };
    add(table.checker, 1, "CHECKER");
    add(table.grid, 2, "GRID");
    add(table.wood, 3, "WOOD");
    add(table.court, 4, "COURT");
    if (!defines.empty()) defines.emplace_back("PATTERNED");
    return defines;
}

std::vector<std::string> defines_for(const View& view, const SurfaceTable& table,
                                     const BackgroundKind& kind, const PartKind& part) {
    const unsigned bodies = part.bodies;
    std::vector<std::string> defines = view_defines(view);
    if (table.planes > 0) defines.push_back("PLANES");
    if (table.planes > kFewPlanes) defines.push_back(kManyPlanes);
    if ((bodies & kBoxes) != 0) defines.push_back("BOXES");
    if ((bodies & kSpheres) != 0) defines.push_back("SPHERES");
    if ((bodies & kOthers) != 0) {
        defines.push_back("OTHERS");
        if (table.capsules) defines.push_back("CAPSULES");
        if (table.cylinders) defines.push_back("CYLINDERS");
        if (table.rings) defines.push_back("RINGS");
        if (table.shells) defines.push_back("SHELLS");
    }
    for (std::string& define : pattern_defines(table, part)) defines.push_back(std::move(define));
    if (has_front(kind, part)) defines.push_back("FRONT");
    if (kind.mirrors) defines.push_back("REFLECTION");
    if (kind.transparent) defines.push_back("TRANSPARENT");
    if (!part.detailed) defines.push_back("COLOR_ALONE");
    if (part.seen != PartView::kAny) {
        defines.push_back("ONE_PLANE");
        if (part.seen == PartView::kGround) defines.push_back("GROUND");
        if (part.seen == PartView::kSky) defines.push_back("SKY");
        return defines;
    }
    // Parallel rays see where a plane ends that they meet edge-on.
    if (table.count() > 1 || table.can_occlude() || view.orthographic())
        defines.push_back("SEVERAL");
    return defines;
}

GlProgram make_program(const Gl& gl, const std::vector<std::string>& defines,
                       const BackgroundKind& kind, const PartKind& part) {
    GlProgram::Sources sources;
    sources.name = "background";
    std::vector<std::string> vertex_defines;
    if (std::find(defines.begin(), defines.end(), kManyPlanes) != defines.end())
        vertex_defines.push_back(kManyPlanes);
    sources.vertex = assemble_shader(vertex_defines, {"background_vertex"});
    sources.fragment =
        assemble_shader(defines, {"surfaces", "other_surfaces", "shells", "surface_light",
                                  "surface_patterns", "background_fragment"});
    sources.attributes = {"a_rectangle", "a_seen", "a_shading", "a_planes"};
    sources.outputs = {"out_color"};  // as BackgroundPicture::targets() has them
    if (part.detailed) sources.outputs.push_back("out_g_buffer");
    if (has_front(kind, part)) sources.outputs.push_back("out_front");
    if (kind.mirrors) sources.outputs.push_back("out_mirror");
    return GlProgram(gl, sources);
}

/// Current in this thread for as long as it lives.
class Current {
  public:
    explicit Current(OffscreenContext& context) : context_(context) { context_.make_current(); }
    ~Current() { context_.release(); }
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;

  private:
    OffscreenContext& context_;
};

}  // namespace

void BackgroundDrawing::aim(const BackgroundPicture& target) {
    framebuffer_ = make_framebuffer(*gl_, "the background", target.targets());
    if (!each_set_) return;
    plain_framebuffer_ = make_framebuffer(*gl_, "the background", target.targets_without_edges());
    color_framebuffer_ = make_framebuffer(*gl_, "the background", {target.targets().front()});
}

GlProgram& BackgroundDrawing::program_for(const View& view, const SurfaceTable& table,
                                          const PartKind& part) {
    std::vector<std::string> defines = defines_for(view, table, kind_, part);
    const auto found = programs_.find(defines);
    if (found != programs_.end()) return found->second;
    GlProgram program = make_program(*gl_, defines, kind_, part);
    return programs_.emplace(std::move(defines), std::move(program)).first->second;
}

void BackgroundDrawing::compile(const View& view, const SurfaceTable& table) {
    program_for(view, table, {.bodies = bodies_in(table)});
}

void BackgroundDrawing::draw(const View& view, const Lights& lights, const SurfaceTable& table,
                             const PictureScale& scale) {
    draw(view, lights, table, scale, sort_into_tiles(table, view, lights, scale), nullptr);
}

void BackgroundDrawing::draw(const View& view, const Lights& lights, const SurfaceTable& table,
                             const PictureScale& scale, const SurfaceTiles& tiles,
                             const TileMask* detailed) {
    BackgroundParts parts;
    if (each_set_)
        parts = divided(tiles, table, view, detailed);
    else
        parts[{.bodies = bodies_in(table)}] = tiles.rectangles;
    const Gl& gl = *gl_;
    GlVec4Array surfaces(gl), listed(gl);
    surfaces.upload(table.vec4s);
    surfaces.bind(0);
    listed.upload(tiles.entries);
    listed.bind(1);
    gl.Disable(GL_BLEND);
    gl.Disable(GL_FRAMEBUFFER_SRGB);  // the shader encodes
    for (const auto& [part, rectangles] : parts) {
        const GlFramebuffer& framebuffer = part.seen == PartView::kAny ? framebuffer_
                                           : part.detailed             ? plain_framebuffer_
                                                                       : color_framebuffer_;
        gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
        gl.Viewport(0, 0, view.width_px(), view.height_px());
        draw_rectangles(program_for(view, table, part), view, lights, table, scale, rectangles);
    }
    gl.Enable(GL_FRAMEBUFFER_SRGB);
    gl.check("drawing the background");
}

void BackgroundDrawing::draw_rectangles(GlProgram& program, const View& view, const Lights& lights,
                                        const SurfaceTable& table, const PictureScale& scale,
                                        const std::vector<float>& rectangles) {
    const Gl& gl = *gl_;
    set_common_uniforms(program, view, lights);
    program.set("u_size", Vec2(view.width_px(), view.height_px()));
    program.set("u_surfaces", 0);
    program.set("u_listed", 1);
    if (table.planes == 1)
        program.set("u_plane", std::vector<float>(table.vec4s.begin(),
                                                  table.vec4s.begin() + 4 * kSurfaceVec4s));
    program.set("u_counts", std::array{table.planes, table.boxes, table.spheres, table.others});
    program.set("u_fade_m", scale.fade_m);
    program.set("u_ao_reach_m", scale.ao_reach_m);

    const GlVertexArray vertex_array(gl);
    const GlBuffer buffer(gl);
    gl.BindVertexArray(vertex_array.name());
    gl.BindBuffer(GL_ARRAY_BUFFER, buffer.name());
    gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(rectangles.size() * sizeof(float)),
                  rectangles.data(), GL_STREAM_DRAW);
    constexpr std::size_t kStride = SurfaceTiles::kRectangleFloats * sizeof(float);
    for (GLuint i = 0; i < SurfaceTiles::kRectangleFloats / 4; ++i) {
        gl.EnableVertexAttribArray(i);
        gl.VertexAttribDivisor(i, 1);
        gl.VertexAttribPointer(i, 4, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(kStride),
                               reinterpret_cast<const void*>(std::size_t{i} * 4 * sizeof(float)));
    }
    gl.DrawArraysInstanced(
        GL_TRIANGLE_STRIP, 0, 4,
        static_cast<GLsizei>(rectangles.size() / SurfaceTiles::kRectangleFloats));
}

double draw_in_second_context(DrawingContexts& contexts, const BackgroundContents& contents,
                              const std::shared_future<const BackgroundPicture*>& target,
                              const std::function<void(const BackgroundPicture&)>& then) {
    const double begin = thread_cpu_s();
    if (!contexts.second) contexts.second.emplace(contexts.main);
    const Current current(*contexts.second);
    const Gl& gl = contexts.second->gl();
    gl.Disable(GL_DITHER);
    gl.Enable(GL_FRAMEBUFFER_SRGB);
    BackgroundDrawing drawing(gl, contents.kind);
    drawing.compile(contents.view, contents.table);
    const BackgroundPicture& picture = *target.get();
    drawing.aim(picture);
    drawing.draw(contents.view, contents.lights, contents.table, contents.scale);
    gl.Flush();  // it is drawn by the driver's own threads meanwhile
    if (then) then(picture);
    gl.Finish();
    return thread_cpu_s() - begin;
}

}  // namespace carom
