// Programs with equal texts are one for the driver, and still each has its own uniforms.
#include "render/gl/gl_program.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "render/gl/offscreen.h"

namespace carom {
namespace {

using Pixel = std::array<std::uint8_t, 4>;

/// A picture of one pixel, in the colour of the program's uniforms.
class OnePixel {
  public:
    explicit OnePixel(const Gl& gl)
        : gl_(gl),
          color_(make_texture(gl, GL_RGBA8, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE)),
          frame_(make_framebuffer(gl, "a test", {&color_})),
          nothing_(gl) {}

    static GlProgram::Sources sources(const char* blue = "0.0") {
        GlProgram::Sources sources;
        sources.name = "one colour";
        sources.vertex =
            "#version 330 core\n"
            "void main() { gl_Position = vec4(4 * (gl_VertexID & 1) - 1,"
            " 4 * (gl_VertexID >> 1) - 1, 0, 1); }\n";
        sources.fragment = std::string(
                               "#version 330 core\n"
                               "uniform float u_red; uniform vec2 u_rest; out vec4 out_color;\n"
                               "void main() { out_color = vec4(u_red, u_rest.x, ") +
                           blue + ", 1.0); }\n";
        sources.outputs = {"out_color"};
        return sources;
    }

    Pixel drawn(GlProgram& program) {
        gl_.BindFramebuffer(GL_FRAMEBUFFER, frame_.name());
        gl_.Viewport(0, 0, 1, 1);
        gl_.BindVertexArray(nothing_.name());
        program.use();
        gl_.DrawArraysInstanced(GL_TRIANGLES, 0, 3, 1);
        Pixel pixel{};
        gl_.ReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
        gl_.check("a test");
        return pixel;
    }

  private:
    const Gl& gl_;
    GlTexture color_;
    GlFramebuffer frame_;
    GlVertexArray nothing_;
};

TEST(GlProgram, OwnersOfOneProgramKeepTheirUniforms) {
    const OffscreenContext context;
    const Gl& gl = context.gl();
    OnePixel picture(gl);
    GlProgram first(gl, OnePixel::sources()), second(gl, OnePixel::sources());
    EXPECT_EQ(1u, gl.programs->by_text.size());
    first.set("u_red", 1.0);
    first.set("u_rest", Vec2(0.2, 0));
    second.set("u_red", 0.4);
    second.set("u_rest", Vec2(0.6, 0));
    EXPECT_EQ((Pixel{255, 51, 0, 255}), picture.drawn(first));
    EXPECT_EQ((Pixel{102, 153, 0, 255}), picture.drawn(second));
    first.set("u_red", 0.0);  // the other value stays what it was
    EXPECT_EQ((Pixel{0, 51, 0, 255}), picture.drawn(first));
    GlProgram moved(std::move(second));
    EXPECT_EQ((Pixel{102, 153, 0, 255}), picture.drawn(moved));
}

TEST(GlProgram, OtherTextsAreOtherPrograms) {
    const OffscreenContext context;
    OnePixel picture(context.gl());
    GlProgram first(context.gl(), OnePixel::sources());
    GlProgram other(context.gl(), OnePixel::sources("1.0"));
    EXPECT_EQ(2u, context.gl().programs->by_text.size());
    EXPECT_EQ((Pixel{0, 0, 255, 255}), picture.drawn(other));
    EXPECT_EQ((Pixel{0, 0, 0, 255}), picture.drawn(first));
}

TEST(GlProgram, PassesOverUniformsThatItDoesNotUse) {
    const OffscreenContext context;
    GlProgram program(context.gl(), OnePixel::sources());
    program.set("u_no_such_thing", 1.0);
    EXPECT_NO_THROW(context.gl().check("setting what is not there"));
}

}  // namespace
}  // namespace carom
