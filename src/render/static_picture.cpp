#include "render/static_picture.h"

namespace carom {

namespace {

GlProgram make_program(const Gl& gl) {
    GlProgram::Sources sources;
    sources.name = "static picture";
    sources.vertex = assemble_shader({}, {"fullscreen_vertex"});
    sources.fragment = assemble_shader({}, {"surfaces", "static_fragment"});
    sources.outputs = {"out_color", "out_front", "out_facts"};
    return GlProgram(gl, sources);
}

}  // namespace

StaticPicture::StaticPicture(const Gl& gl, const View& view, const Lights& lights,
                             const SurfaceTable& table, const PictureScale& scale) {
    const int width = view.width_px(), height = view.height_px();
    color_ = make_texture(gl, GL_SRGB8_ALPHA8, width, height, GL_RGBA, GL_UNSIGNED_BYTE);
    front_ = make_texture(gl, GL_SRGB8_ALPHA8, width, height, GL_RGBA, GL_UNSIGNED_BYTE);
    facts_ = make_texture(gl, GL_RGBA32UI, width, height, GL_RGBA_INTEGER, GL_UNSIGNED_INT);
    const GlFramebuffer all =
        make_framebuffer(gl, "the static picture", {&color_, &front_, &facts_});

    const GlProgram program = make_program(gl);
    set_common_uniforms(gl, program, view, lights);
    gl.Uniform1i(program.uniform("u_surfaces"), 0);
    gl.Uniform4i(program.uniform("u_counts"), table.planes, table.boxes, table.spheres,
                 table.capsules);
    gl.Uniform1f(program.uniform("u_fade_m"), static_cast<float>(scale.fade_m));
    gl.Uniform1f(program.uniform("u_ao_reach_m"), static_cast<float>(scale.ao_reach_m));
    GlVec4Array surfaces(gl);
    surfaces.upload(table.vec4s);
    surfaces.bind(0);

    const GlVertexArray nothing(gl);
    gl.BindVertexArray(nothing.name());
    gl.Viewport(0, 0, width, height);
    gl.Disable(GL_BLEND);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.check("drawing the static picture");

    color_framebuffer_ = make_framebuffer(gl, "copies of the static picture", {&color_});
}

}  // namespace carom
