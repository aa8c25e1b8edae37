// Shader programs: linked once for equal texts, each owner with values of its own for the uniforms.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/types.h"
#include "render/gl/gl.h"

namespace carom {

/// The programs that a context has linked, by their texts. They go with the context.
struct GlLinkedPrograms {
    struct Linked {
        GLuint name = 0;
        std::uint64_t owners = 0;  ///< counted from 1
        std::uint64_t values = 0;  ///< the owner whose uniforms the program has now
    };
    std::map<std::string, Linked> by_text;  ///< addresses of the entries stay
};

/// A linked program. Vertex attributes are bound by the order of `attributes`, fragment outputs by
/// the order of `outputs`. Where another one has the same sources, the driver has one program for
/// both (drivers take their time to compile).
class GlProgram {
  public:
    struct Sources {
        std::string name;    ///< for messages
        std::string vertex;  ///< whole text, its `#version` included
        std::string fragment;
        std::vector<const char*> attributes;
        std::vector<const char*> outputs;
    };
    GlProgram() = default;
    /// Failure(kRun) with the name of the program and the driver's log.
    GlProgram(const Gl& gl, const Sources& sources);
    GlProgram(GlProgram&&) noexcept = default;
    GlProgram& operator=(GlProgram&&) noexcept = default;

    /// For the next drawing, with what was set.
    void use();

    /// Uses the program and sets a uniform of it. A name that the program does not use is passed
    /// over, since drivers leave out what has no effect.
    void set(const char* name, int value);
    void set(const char* name, const std::array<int, 4>& value);
    void set(const char* name, double value);
    void set(const char* name, const Vec2& value);
    void set(const char* name, const Vec3& value);
    /// An array of vec4 of the shader, 8 at most.
    void set(const char* name, const std::vector<float>& vec4s);

  private:
    struct Value {
        GLint location = -1;
        int count = 0;  ///< of numbers
        bool whole = false;
        std::array<float, 32> floats{};
        std::array<int, 4> ints{};
    };
    void keep(const char* name, Value value);
    void send(const Value& value) const;

    const Gl* gl_ = nullptr;
    GlLinkedPrograms::Linked* linked_ = nullptr;
    std::uint64_t owner_ = 0;
    std::vector<Value> values_;
};

/// A whole shader text: version, one `#define` per entry, common.glsl, and the named files.
std::string assemble_shader(const std::vector<std::string>& defines,
                            const std::vector<std::string_view>& files);

}  // namespace carom
