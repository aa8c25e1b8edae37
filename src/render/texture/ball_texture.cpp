#include "render/texture/ball_texture.h"

#include <array>
#include <vector>

#include "render/blend/srgb.h"
#include "render/gl/gl_program.h"

namespace carom {

namespace {

/// As ball_markings.glsl names the styles that are painted on balls.
constexpr std::array<const char*, 7> kStyleNames = {
    "PLAIN", "STRIPED", "BASKETBALL", "VOLLEYBALL", "FOOTBALL", "TENNIS", "TABLE_TENNIS"};

/// RGBA in linear light, row 0 first -> the picture.
Image encoded(const std::vector<float>& pixels) {
    Image image(BallTextures::kWidth, BallTextures::kHeight);
    const SrgbEncoder& encode = srgb_encoder();
    for (std::size_t i = 0; i < pixels.size(); i += 4) {
        for (std::size_t channel = 0; channel < 3; ++channel)
            image.bgra[i + channel] = encode(static_cast<double>(pixels[i + 2 - channel]));
        image.bgra[i + 3] = 255;
    }
    return image;
}

}  // namespace

bool has_markings(const Look& look) {
    return look.style != LookStyle::kPlain && look.style < LookStyle::kChecker;
}

Image BallTextures::draw(const Look& look) {
    context_.make_current();
    const Gl& gl = context_.gl();
    const std::size_t style = has_markings(look) ? static_cast<std::size_t>(look.style) : 0;
    GlProgram::Sources sources;
    sources.name = "ball texture";
    sources.vertex = assemble_shader({}, {"texture_vertex"});
    sources.fragment =
        assemble_shader({kStyleNames.at(style)}, {"ball_markings", "texture_fragment"});
    sources.outputs = {"out_color"};
    GlProgram program(gl, sources);
    program.set("u_size", Vec2(kWidth, kHeight));
    program.set("u_color", linear_light(look.color));
    program.set("u_second", linear_light(look.second_color));

    const GlTexture texture = make_texture(gl, GL_RGBA16F, kWidth, kHeight, GL_RGBA, GL_FLOAT);
    const GlFramebuffer framebuffer = make_framebuffer(gl, "ball textures", {&texture});
    const GlVertexArray no_attributes(gl);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    gl.BindVertexArray(no_attributes.name());
    gl.Viewport(0, 0, kWidth, kHeight);
    gl.Disable(GL_BLEND);
    program.use();
    gl.DrawArraysInstanced(GL_TRIANGLES, 0, 3, 1);
    std::vector<float> pixels(std::size_t{4} * kWidth * kHeight);
    gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
    gl.ReadPixels(0, 0, kWidth, kHeight, GL_RGBA, GL_FLOAT, pixels.data());
    gl.check("drawing the markings of a ball");
    return encoded(pixels);
}

}  // namespace carom
