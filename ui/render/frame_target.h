// Where a frame is drawn when not straight into the window: smaller, or with several samples a
// pixel.
#pragma once

#include "core/files/picture_file.h"
#include "ui/render/opengl/frame_buffer.h"

#include <optional>

namespace marsview {

/// A frame buffer with color and depth that is kept between frames of the same kind.
class FrameTarget {
public:
    /// Binds a buffer of that size. `samples` of 0 or 1 means one sample per pixel; a larger count
    /// is limited to the driver's maximum.
    void begin(const Viewport& size, int samples);
    /// Ends the frame and resolves its samples.
    void end();
    /// Copies the colors into `target` and leaves that bound; interpolates if the sizes differ.
    /// Call any number of times after end().
    void present(GLuint target, const Viewport& target_size);
    /// The same for the depths in an area of `target`, whose depth buffer has 24 bits and 8 bits of
    /// stencil.
    void presentDepth(GLuint target, const Viewport& target_size, const PixelArea& area);

    /// What was drawn, one sample a pixel. Call after end().
    const FrameBuffer& drawn() const;
    /// The colors that were drawn.
    Picture colors() const;
    /// Replaces them by those of a picture of the same size.
    void setColors(const Picture& colors);

private:
    std::optional<FrameBuffer> drawn_;
};

} // namespace marsview
