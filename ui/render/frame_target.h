// Where a frame is drawn when not straight into the window: smaller, or with several samples a
// pixel.
#pragma once

#include "ui/render/frame_buffer.h"

#include <optional>

namespace marsview {

/// A frame buffer with colour and depth that is kept between frames of the same kind.
class FrameTarget {
public:
    /// Binds a buffer of that size; `samples` of 0 or 1 is one a pixel, more are as many as the
    /// driver has up to that.
    void begin(const Viewport& size, int samples);
    /// What was begun is drawn.
    void end();
    /// Copies colours, smoothed where sizes differ, into `target` and leaves that bound. As often
    /// as wanted after end().
    void present(GLuint target, const Viewport& target_size);
    /// The same for the depths in a part of `target`, whose depth buffer has 24 bits and a stencil
    /// of 8.
    void presentDepth(GLuint target, const Viewport& target_size, const PixelArea& area);

private:
    std::optional<FrameBuffer> drawn_;
};

} // namespace marsview
