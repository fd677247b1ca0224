// A frame buffer of our own to draw into.
#pragma once

#include "core/view/camera.h"
#include "ui/render/opengl/gl_objects.h"

namespace marsview {

/// Colors in RGBA8, depths in 24 bits with a stencil of 8, as windows have them: depths can be
/// copied between the two.
class FrameBuffer {
public:
    /// `samples` of 0 or 1 is one a pixel, more are as many as the driver has up to that. Leaves it
    /// bound.
    explicit FrameBuffer(const Viewport& size, int samples = 1);

    GLuint id() const noexcept { return frame_.id(); }
    const Viewport& size() const noexcept { return size_; }
    int samples() const noexcept { return samples_; }
    /// The depths; with one sample a pixel only.
    GLuint depthTexture() const noexcept { return depth_texture_.id(); }
    /// False where the driver cannot draw into one like this. Leaves it bound.
    bool isComplete() const;

private:
    Viewport size_;
    int samples_ = 1;
    GlFramebuffer frame_;
    GlRenderbuffer color_;
    GlRenderbuffer depth_; // with several samples a pixel; otherwise the texture
    GlTexture depth_texture_;
};

} // namespace marsview
