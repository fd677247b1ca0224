#include "ui/render/opengl/gl_program.h"

#include <array>
#include <epoxy/gl.h>
#include <utility>

namespace marsview {
namespace {

Result<GLuint> compiled(GLenum stage, const char* source)
{
    const GLuint shader = glCreateShader(stage);
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint is_compiled = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &is_compiled);
    if (is_compiled == GL_TRUE) {
        return shader;
    }
    std::array<char, 1024> log{};
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    glDeleteShader(shader);
    return Error{ErrorCode::Unsupported,
                 std::string("this OpenGL driver cannot compile a shader: ") + log.data()};
}

} // namespace

Result<GlProgram> GlProgram::create(const char* vertex_source, const char* fragment_source)
{
    Result<GLuint> vertex = compiled(GL_VERTEX_SHADER, vertex_source);
    if (!vertex) {
        return std::move(vertex).error();
    }
    Result<GLuint> fragment = compiled(GL_FRAGMENT_SHADER, fragment_source);
    if (!fragment) {
        glDeleteShader(*vertex);
        return std::move(fragment).error();
    }
    GlProgram program(glCreateProgram());
    glAttachShader(program.id_, *vertex);
    glAttachShader(program.id_, *fragment);
    glLinkProgram(program.id_);
    glDeleteShader(*vertex);
    glDeleteShader(*fragment);
    GLint is_linked = GL_FALSE;
    glGetProgramiv(program.id_, GL_LINK_STATUS, &is_linked);
    if (is_linked != GL_TRUE) {
        std::array<char, 1024> log{};
        glGetProgramInfoLog(program.id_, static_cast<GLsizei>(log.size()), nullptr, log.data());
        return Error{ErrorCode::Unsupported,
                     std::string("this OpenGL driver cannot link a shader: ") + log.data()};
    }
    return program;
}

GlProgram::GlProgram(GlProgram&& other) noexcept
    : id_(std::exchange(other.id_, 0))
{}

GlProgram& GlProgram::operator=(GlProgram&& other) noexcept
{
    std::swap(id_, other.id_);
    return *this;
}

GlProgram::~GlProgram()
{
    if (id_ != 0) {
        glDeleteProgram(id_);
    }
}

int GlProgram::uniform(const char* name) const
{
    return glGetUniformLocation(id_, name);
}

} // namespace marsview
