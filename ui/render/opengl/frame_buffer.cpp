#include "ui/render/opengl/frame_buffer.h"

#include <algorithm>

namespace marsview {

FrameBuffer::FrameBuffer(const Viewport& size, int samples)
    : size_(size)
    , samples_(samples)
{
    GLint samples_max = 0;
    glGetIntegerv(GL_MAX_SAMPLES, &samples_max);
    const GLsizei count = samples > 1 ? std::min(samples, samples_max) : 0;
    const auto allocate = [&](const GlRenderbuffer& buffer, GLenum format) {
        glBindRenderbuffer(GL_RENDERBUFFER, buffer.id());
        glRenderbufferStorageMultisample(GL_RENDERBUFFER, count, format, size.width, size.height);
    };
    allocate(color_, GL_RGBA8);
    if (count > 0) {
        allocate(depth_, GL_DEPTH24_STENCIL8);
    } else {
        glBindTexture(GL_TEXTURE_2D, depth_texture_.id());
        glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH24_STENCIL8, size.width, size.height, 0,
                     GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8, nullptr);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        glBindTexture(GL_TEXTURE_2D, 0);
    }
    glBindRenderbuffer(GL_RENDERBUFFER, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, frame_.id());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_.id());
    if (count > 0) {
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER,
                                  depth_.id());
    } else {
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D,
                               depth_texture_.id(), 0);
    }
}

bool FrameBuffer::isComplete() const
{
    glBindFramebuffer(GL_FRAMEBUFFER, frame_.id());
    return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

} // namespace marsview
