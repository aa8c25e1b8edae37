#include "render/gl/gl.h"

#include <fmt/core.h>

#include <bit>

#include "core/failure.h"
#include "render/gl/gl_program.h"

namespace carom {

namespace {

const char* error_name(GLenum error) {
    switch (error) {
        case GL_INVALID_ENUM:
            return "GL_INVALID_ENUM";
        case GL_INVALID_VALUE:
            return "GL_INVALID_VALUE";
        case GL_INVALID_OPERATION:
            return "GL_INVALID_OPERATION";
        case GL_INVALID_FRAMEBUFFER_OPERATION:
            return "GL_INVALID_FRAMEBUFFER_OPERATION";
        default:
            return "unknown error";
    }
}

const char* status_name(GLenum status) {
    switch (status) {
        case GL_FRAMEBUFFER_UNDEFINED:
            return "GL_FRAMEBUFFER_UNDEFINED";
        case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
            return "GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT";
        case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
            return "GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT";
        case GL_FRAMEBUFFER_INCOMPLETE_DRAW_BUFFER:
            return "GL_FRAMEBUFFER_INCOMPLETE_DRAW_BUFFER";
        default:
            return "unknown status";
    }
}

/// llvmpipe (22.3) compiles a shader again for a buffer texture whose size is a power of two, and
/// for one where the second byte of its size in bytes is zero: no array here has such a size. None
/// is empty either, which would leave the texture without storage.
std::size_t padded_size(std::size_t vec4s) {
    if (vec4s % 4096 < 16) vec4s = vec4s / 4096 * 4096 + 17;
    return std::has_single_bit(vec4s) ? vec4s + 1 : vec4s;
}

}  // namespace

Gl Gl::load(Loader loader) {
    Gl gl;
    gl.programs = std::make_shared<GlLinkedPrograms>();
#define CAROM_GL_LOAD(type, name)                         \
    gl.name = reinterpret_cast<type>(loader("gl" #name)); \
    if (gl.name == nullptr)                               \
        throw Failure(FailureKind::kRun, "the OpenGL library has no entry point gl" #name);
    CAROM_GL_FUNCTIONS(CAROM_GL_LOAD)
#undef CAROM_GL_LOAD
    return gl;
}

void Gl::check(const std::string& attempted) const {
    const GLenum error = GetError();
    if (error == GL_OUT_OF_MEMORY)
        throw Failure(FailureKind::kRun,
                      fmt::format("out of memory: the driver had no room while {}; draw a smaller "
                                  "picture (--size)",
                                  attempted));
    if (error != GL_NO_ERROR)
        throw Failure(FailureKind::kRun, fmt::format("OpenGL failed while {}: {} ({:#x})",
                                                     attempted, error_name(error), error));
}

GlTexture make_texture(const Gl& gl, GLint internal_format, int width, int height, GLenum format,
                       GLenum type, const void* pixels) {
    GlTexture texture(gl);
    gl.BindTexture(GL_TEXTURE_2D, texture.name());
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    // Only now, or drivers make room for smaller levels as well.
    gl.TexImage2D(GL_TEXTURE_2D, 0, internal_format, width, height, 0, format, type, pixels);
    return texture;
}

GlFramebuffer make_framebuffer(const Gl& gl, const std::string& purpose,
                               const std::vector<const GlTexture*>& colors) {
    GlFramebuffer framebuffer(gl);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    std::vector<GLenum> attachments;
    for (const GlTexture* color : colors) {
        attachments.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachments.size()));
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, attachments.back(), GL_TEXTURE_2D, color->name(),
                                0);
    }
    gl.DrawBuffers(static_cast<GLsizei>(attachments.size()), attachments.data());
    const GLenum status = gl.CheckFramebufferStatus(GL_FRAMEBUFFER);
    // Drivers have to support these formats: what they lack is memory, which they ask for late.
    if (status == GL_FRAMEBUFFER_UNSUPPORTED)
        throw Failure(FailureKind::kRun,
                      fmt::format("out of memory: the driver has no room for {}; draw a smaller "
                                  "picture (--size)",
                                  purpose));
    if (status != GL_FRAMEBUFFER_COMPLETE)
        throw Failure(FailureKind::kRun,
                      fmt::format("the framebuffer for {} is incomplete: {} ({:#x})", purpose,
                                  status_name(status), status));
    return framebuffer;
}

GlVec4Array::GlVec4Array(const Gl& gl) : gl_(&gl), buffer_(gl), texture_(gl) {
    GLint most = 0;
    gl.GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    most_vec4s_ = static_cast<std::size_t>(most);
    upload({0, 0, 0, 0});
    gl.BindTexture(GL_TEXTURE_BUFFER, texture_.name());
    gl.TexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, buffer_.name());
}

void GlVec4Array::upload(const std::vector<float>& floats) {
    if (floats.size() / 4 > most_vec4s_)
        throw Failure(FailureKind::kRun,
                      fmt::format("a frame needs {} values for its shaders, the driver takes {}",
                                  floats.size() / 4, most_vec4s_));
    const auto send = [&](const std::vector<float>& values) {
        gl_->BindBuffer(GL_TEXTURE_BUFFER, buffer_.name());
        gl_->BufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(values.size() * sizeof(float)),
                        values.data(), GL_STREAM_DRAW);
    };
    const std::size_t vec4s = floats.size() / 4, padded = padded_size(vec4s);
    if (padded == vec4s) return send(floats);
    std::vector<float> longer = floats;
    longer.resize(4 * padded);
    send(longer);
}

void GlVec4Array::bind(int unit) const {
    gl_->ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    gl_->BindTexture(GL_TEXTURE_BUFFER, texture_.name());
}

}  // namespace carom
