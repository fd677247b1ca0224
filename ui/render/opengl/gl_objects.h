// OpenGL objects that are deleted with their owner. Create, use and destroy them with the same
// context current.
#pragma once

#include <epoxy/gl.h>
#include <utility>

namespace marsview {

/// Owns one name of a kind of object. Move only.
template <auto Create, auto Delete>
class GlObject {
public:
    GlObject() { (*Create)(1, &id_); }
    ~GlObject()
    {
        if (id_ != 0) {
            (*Delete)(1, &id_);
        }
    }
    GlObject(GlObject&& other) noexcept
        : id_(std::exchange(other.id_, 0))
    {}
    GlObject& operator=(GlObject&& other) noexcept
    {
        std::swap(id_, other.id_);
        return *this;
    }
    GlObject(const GlObject&) = delete;
    GlObject& operator=(const GlObject&) = delete;

    GLuint id() const noexcept { return id_; }

private:
    GLuint id_ = 0;
};

// epoxy's functions are pointers that it fills in at the first call: they are taken by address.
using GlBuffer = GlObject<&epoxy_glGenBuffers, &epoxy_glDeleteBuffers>;
using GlVertexArray = GlObject<&epoxy_glGenVertexArrays, &epoxy_glDeleteVertexArrays>;
using GlTexture = GlObject<&epoxy_glGenTextures, &epoxy_glDeleteTextures>;
using GlFramebuffer = GlObject<&epoxy_glGenFramebuffers, &epoxy_glDeleteFramebuffers>;
using GlRenderbuffer = GlObject<&epoxy_glGenRenderbuffers, &epoxy_glDeleteRenderbuffers>;

} // namespace marsview
