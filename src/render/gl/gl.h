// OpenGL 3.3 core as carom uses it: a table of entry points, and move-only owners of its objects
// (programs: gl_program.h).
//
// The table is filled through a loader of the back end (OSMesaGetProcAddress, eglGetProcAddress),
// because no loader library works under OSMesa. Everything here belongs to one
// context and must be used and destroyed while that context is current; the table must outlive the
// owners. A failed compilation, link or framebuffer is Failure(kRun) with the driver's own text.
#pragma once

#include <GL/glcorearb.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace carom {

/// The version that is asked for and needed: softer drivers, EGL and GPUs have it too.
inline constexpr int kGlMajor = 3, kGlMinor = 3;

// clang-format off
/// Every entry point that carom calls: X(type of the pointer, name without "gl").
#define CAROM_GL_FUNCTIONS(X)                                                                     \
    X(PFNGLACTIVETEXTUREPROC, ActiveTexture) X(PFNGLATTACHSHADERPROC, AttachShader)               \
    X(PFNGLBINDATTRIBLOCATIONPROC, BindAttribLocation)                                            \
    X(PFNGLBINDBUFFERPROC, BindBuffer) X(PFNGLBINDFRAGDATALOCATIONPROC, BindFragDataLocation)     \
    X(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer) X(PFNGLBINDTEXTUREPROC, BindTexture)             \
    X(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                                                  \
    X(PFNGLBLENDFUNCSEPARATEPROC, BlendFuncSeparate)                                              \
    X(PFNGLBLITFRAMEBUFFERPROC, BlitFramebuffer) X(PFNGLBUFFERDATAPROC, BufferData)               \
    X(PFNGLCHECKFRAMEBUFFERSTATUSPROC, CheckFramebufferStatus) X(PFNGLCLEARPROC, Clear)           \
    X(PFNGLCLEARCOLORPROC, ClearColor)                                                            \
    X(PFNGLCOMPILESHADERPROC, CompileShader) X(PFNGLCREATEPROGRAMPROC, CreateProgram)             \
    X(PFNGLCREATESHADERPROC, CreateShader) X(PFNGLDELETEBUFFERSPROC, DeleteBuffers)               \
    X(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers) X(PFNGLDELETEPROGRAMPROC, DeleteProgram)   \
    X(PFNGLDELETESHADERPROC, DeleteShader) X(PFNGLDELETETEXTURESPROC, DeleteTextures)             \
    X(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays) X(PFNGLDISABLEPROC, Disable)               \
    X(PFNGLDRAWARRAYSINSTANCEDPROC, DrawArraysInstanced) X(PFNGLFLUSHPROC, Flush)                 \
    X(PFNGLDRAWBUFFERSPROC, DrawBuffers) X(PFNGLENABLEPROC, Enable)                               \
    X(PFNGLENABLEVERTEXATTRIBARRAYPROC, EnableVertexAttribArray) X(PFNGLFINISHPROC, Finish)       \
    X(PFNGLFRAMEBUFFERTEXTURE2DPROC, FramebufferTexture2D) X(PFNGLGENBUFFERSPROC, GenBuffers)     \
    X(PFNGLGENFRAMEBUFFERSPROC, GenFramebuffers) X(PFNGLGENTEXTURESPROC, GenTextures)             \
    X(PFNGLGENVERTEXARRAYSPROC, GenVertexArrays) X(PFNGLGETERRORPROC, GetError)                   \
    X(PFNGLGETINTEGERVPROC, GetIntegerv) X(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)         \
    X(PFNGLGETPROGRAMIVPROC, GetProgramiv) X(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)         \
    X(PFNGLGETSHADERIVPROC, GetShaderiv) X(PFNGLGETSTRINGPROC, GetString)                         \
    X(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation) X(PFNGLLINKPROGRAMPROC, LinkProgram)       \
    X(PFNGLPIXELSTOREIPROC, PixelStorei) X(PFNGLREADBUFFERPROC, ReadBuffer)                       \
    X(PFNGLREADPIXELSPROC, ReadPixels) X(PFNGLSHADERSOURCEPROC, ShaderSource)                     \
    X(PFNGLTEXBUFFERPROC, TexBuffer) X(PFNGLTEXIMAGE2DPROC, TexImage2D)                           \
    X(PFNGLTEXPARAMETERIPROC, TexParameteri) X(PFNGLTEXSUBIMAGE2DPROC, TexSubImage2D)             \
    X(PFNGLUNIFORM1FPROC, Uniform1f) X(PFNGLUNIFORM1IPROC, Uniform1i)                             \
    X(PFNGLUNIFORM2FPROC, Uniform2f) X(PFNGLUNIFORM3FPROC, Uniform3f)                             \
    X(PFNGLUNIFORM4FVPROC, Uniform4fv) X(PFNGLUNIFORM4IPROC, Uniform4i)                           \
    X(PFNGLUSEPROGRAMPROC, UseProgram)                                                            \
    X(PFNGLVERTEXATTRIBDIVISORPROC, VertexAttribDivisor)                                          \
    X(PFNGLVERTEXATTRIBPOINTERPROC, VertexAttribPointer) X(PFNGLVIEWPORTPROC, Viewport)
// clang-format on

struct GlLinkedPrograms;

/// The entry points of one back end, and what its context keeps.
struct Gl {
#define CAROM_GL_MEMBER(type, name) type name = nullptr;
    CAROM_GL_FUNCTIONS(CAROM_GL_MEMBER)
#undef CAROM_GL_MEMBER

    using Procedure = void (*)();
    using Loader = Procedure (*)(const char* name);
    /// Failure(kRun) with the name of an entry point that the loader does not know. A loader may
    /// return a pointer for a name that does not exist, so the version must be checked as well.
    static Gl load(Loader loader);

    /// Of this context (render/gl/gl_program.h).
    std::shared_ptr<GlLinkedPrograms> programs;

    /// Failure(kRun) naming `attempted` if any error has been raised since the last call.
    void check(const std::string& attempted) const;
};

/// Owns one GL name, made and deleted by these entry points.
template <auto kGenerate, auto kDelete>
class GlObject {
  public:
    GlObject() = default;
    explicit GlObject(const Gl& gl) : gl_(&gl) { (gl.*kGenerate)(1, &name_); }
    ~GlObject() { reset(); }
    GlObject(GlObject&& other) noexcept : gl_(other.gl_), name_(other.name_) { other.name_ = 0; }
    GlObject& operator=(GlObject&& other) noexcept {
        if (this != &other) {
            reset();
            gl_ = other.gl_;
            name_ = other.name_;
            other.name_ = 0;
        }
        return *this;
    }

    GLuint name() const { return name_; }
    explicit operator bool() const { return name_ != 0; }

  private:
    void reset() {
        if (name_ != 0) (gl_->*kDelete)(1, &name_);
        name_ = 0;
    }
    const Gl* gl_ = nullptr;
    GLuint name_ = 0;
};

using GlBuffer = GlObject<&Gl::GenBuffers, &Gl::DeleteBuffers>;
using GlTexture = GlObject<&Gl::GenTextures, &Gl::DeleteTextures>;
using GlFramebuffer = GlObject<&Gl::GenFramebuffers, &Gl::DeleteFramebuffers>;
using GlVertexArray = GlObject<&Gl::GenVertexArrays, &Gl::DeleteVertexArrays>;

/// A 2-D texture without mipmaps, nearest filtering, clamped; `format` and `type` describe `pixels`
/// (null: contents undefined).
GlTexture make_texture(const Gl& gl, GLint internal_format, int width, int height, GLenum format,
                       GLenum type, const void* pixels = nullptr);

/// A framebuffer that draws into the given colour textures; checked to be complete.
GlFramebuffer make_framebuffer(const Gl& gl, const std::string& purpose,
                               const std::vector<const GlTexture*>& colors);

/// A one-dimensional array of vec4 that shaders read with texelFetch from a samplerBuffer.
class GlVec4Array {
  public:
    GlVec4Array() = default;
    explicit GlVec4Array(const Gl& gl);
    /// Replaces the contents; `floats` is a multiple of four long. Failure(kRun) beyond what the
    /// driver can address, where shaders would read zeros.
    void upload(const std::vector<float>& floats);
    void bind(int unit) const;

  private:
    const Gl* gl_ = nullptr;
    std::size_t most_vec4s_ = 0;
    GlBuffer buffer_;
    GlTexture texture_;
};

}  // namespace carom
