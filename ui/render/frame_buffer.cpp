#include "ui/render/frame_buffer.h"

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
    allocate(depth_, GL_DEPTH24_STENCIL8);
    glBindRenderbuffer(GL_RENDERBUFFER, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, frame_.id());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_.id());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER,
                              depth_.id());
}

bool FrameBuffer::isComplete() const
{
    glBindFramebuffer(GL_FRAMEBUFFER, frame_.id());
    return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

} // namespace marsview
