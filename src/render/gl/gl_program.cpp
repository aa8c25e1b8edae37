#include "render/gl/gl_program.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "core/check.h"
#include "core/failure.h"
#include "render/gl/shader_sources.h"

namespace carom {

namespace {

/// The driver's log without trailing line ends.
std::string trimmed(std::string log, GLsizei length) {
    log.resize(static_cast<std::size_t>(length));
    while (!log.empty() && (log.back() == '\n' || log.back() == '\0')) log.pop_back();
    return log;
}

constexpr GLsizei kLogBytes = 8192;

/// Deletes the shader when it goes out of scope; a linked program keeps what it needs.
class Shader {
  public:
    Shader(const Gl& gl, GLenum stage, const std::string& text, const std::string& program)
        : gl_(gl), name_(gl.CreateShader(stage)) {
        const char* source = text.c_str();
        gl.ShaderSource(name_, 1, &source, nullptr);
        gl.CompileShader(name_);
        GLint compiled = GL_FALSE;
        gl.GetShaderiv(name_, GL_COMPILE_STATUS, &compiled);
        if (compiled == GL_TRUE) return;
        std::string log(static_cast<std::size_t>(kLogBytes), '\0');
        GLsizei length = 0;
        gl.GetShaderInfoLog(name_, kLogBytes, &length, log.data());
        gl.DeleteShader(name_);
        throw Failure(FailureKind::kRun,
                      fmt::format("the {} shader \"{}\" does not compile: {}",
                                  stage == GL_VERTEX_SHADER ? "vertex" : "fragment", program,
                                  trimmed(std::move(log), length)));
    }
    ~Shader() { gl_.DeleteShader(name_); }
    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;
    GLuint name() const { return name_; }

  private:
    const Gl& gl_;
    GLuint name_;
};

GLuint link(const Gl& gl, const GlProgram::Sources& sources) {
    const Shader vertex(gl, GL_VERTEX_SHADER, sources.vertex, sources.name);
    const Shader fragment(gl, GL_FRAGMENT_SHADER, sources.fragment, sources.name);
    const GLuint program = gl.CreateProgram();
    gl.AttachShader(program, vertex.name());
    gl.AttachShader(program, fragment.name());
    for (std::size_t i = 0; i < sources.attributes.size(); ++i)
        gl.BindAttribLocation(program, static_cast<GLuint>(i), sources.attributes[i]);
    for (std::size_t i = 0; i < sources.outputs.size(); ++i)
        gl.BindFragDataLocation(program, static_cast<GLuint>(i), sources.outputs[i]);
    gl.LinkProgram(program);

    GLint linked = GL_FALSE;
    gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked == GL_TRUE) return program;
    std::string log(static_cast<std::size_t>(kLogBytes), '\0');
    GLsizei length = 0;
    gl.GetProgramInfoLog(program, kLogBytes, &length, log.data());
    gl.DeleteProgram(program);
    throw Failure(FailureKind::kRun, fmt::format("the shader program \"{}\" does not link: {}",
                                                 sources.name, trimmed(std::move(log), length)));
}

std::string whole_text(const GlProgram::Sources& sources) {
    std::string text = sources.vertex + '\0' + sources.fragment;
    for (const auto* names : {&sources.attributes, &sources.outputs}) {
        text += '\0';
        for (const char* name : *names) text += std::string(name) + ' ';
    }
    return text;
}

}  // namespace

GlProgram::GlProgram(const Gl& gl, const Sources& sources)
    : gl_(&gl), linked_(&gl.programs->by_text[whole_text(sources)]) {
    if (linked_->name == 0) linked_->name = link(gl, sources);
    owner_ = ++linked_->owners;
}

void GlProgram::use() {
    gl_->UseProgram(linked_->name);
    if (linked_->values == owner_) return;
    linked_->values = owner_;
    for (const Value& value : values_) send(value);
}

void GlProgram::send(const Value& value) const {
    const auto& f = value.floats;
    const auto& i = value.ints;
    if (value.whole)
        value.count == 1 ? gl_->Uniform1i(value.location, i[0])
                         : gl_->Uniform4i(value.location, i[0], i[1], i[2], i[3]);
    else if (value.count > 3)
        gl_->Uniform4fv(value.location, value.count / 4, f.data());
    else if (value.count == 1)
        gl_->Uniform1f(value.location, f[0]);
    else if (value.count == 2)
        gl_->Uniform2f(value.location, f[0], f[1]);
    else
        gl_->Uniform3f(value.location, f[0], f[1], f[2]);
}

void GlProgram::keep(const char* name, Value value) {
    use();
    value.location = gl_->GetUniformLocation(linked_->name, name);
    if (value.location < 0) return;
    const auto old = std::find_if(values_.begin(), values_.end(), [&](const Value& other) {
        return other.location == value.location;
    });
    if (old == values_.end())
        values_.push_back(value);
    else
        *old = value;
    send(value);
}

void GlProgram::set(const char* name, int value) { keep(name, {-1, 1, true, {}, {value}}); }
void GlProgram::set(const char* name, const std::array<int, 4>& value) {
    keep(name, {-1, 4, true, {}, value});
}
void GlProgram::set(const char* name, double value) {
    keep(name, {-1, 1, false, {static_cast<float>(value)}, {}});
}
void GlProgram::set(const char* name, const Vec2& value) {
    const Eigen::Vector2f f = value.cast<float>();
    keep(name, {-1, 2, false, {f.x(), f.y()}, {}});
}
void GlProgram::set(const char* name, const Vec3& value) {
    const Eigen::Vector3f f = value.cast<float>();
    keep(name, {-1, 3, false, {f.x(), f.y(), f.z()}, {}});
}

void GlProgram::set(const char* name, const std::vector<float>& vec4s) {
    Value value{-1, static_cast<int>(vec4s.size()), false, {}, {}};
    CAROM_CHECK(vec4s.size() % 4, ==, std::size_t{0});
    CAROM_CHECK(vec4s.size(), <=, value.floats.size());
    std::copy(vec4s.begin(), vec4s.end(), value.floats.begin());
    keep(name, value);
}

std::string assemble_shader(const std::vector<std::string>& defines,
                            const std::vector<std::string_view>& files) {
    std::string text = "#version 330 core\n";
    for (const std::string& define : defines) text += "#define " + define + "\n";
    text += shader_source("common");
    for (const std::string_view file : files) {
        const std::string_view body = shader_source(file);
        if (body.empty())
            throw Failure(FailureKind::kRun, fmt::format("no shader file \"{}.glsl\"", file));
        text += body;
    }
    return text;
}

}  // namespace carom
