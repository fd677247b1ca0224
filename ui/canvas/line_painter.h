// Painting lines and dots over the terrain of a view.
#pragma once

#include "core/base/result.h"
#include "ui/canvas/line_sets.h"
#include "ui/render/dot_renderer.h"
#include "ui/render/line_renderer.h"
#include "ui/render/opengl/frame_buffer.h"
#include "ui/render/terrain_renderer.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace marsview {

/// The picture of the terrain that is painted over.
enum class TerrainPicture : std::uint8_t {
    New,  // it is in the frame buffer
    Same, // as when lines were painted last; it is not in the frame buffer
};

/// Every call needs the context current in which it was created, the destructor included.
class LinePainter {
public:
    static Result<std::unique_ptr<LinePainter>> create();

    /// Leaves the picture of `terrain` with the lines over it in `frame_buffer`, which has a
    /// stencil of 8 bits. While neither changes, it is a copy of the one before.
    void paint(const LineSets& sets,
               TerrainRenderer& terrain,
               TerrainPicture terrain_picture,
               const LinePicture& picture,
               unsigned frame_buffer);
    LineRenderer& lines() noexcept { return *lines_; }

private:
    LinePainter(std::unique_ptr<LineRenderer> lines, std::unique_ptr<DotRenderer> dots);

    std::unique_ptr<LineRenderer> lines_;
    std::unique_ptr<DotRenderer> dots_;
    std::uint64_t painted_of_ = 0; // revision of the sets
    std::optional<FrameBuffer> kept_;
    bool is_kept_current_ = false; // terrain, and lines as of painted_of_
};

} // namespace marsview
