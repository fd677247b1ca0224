// The cursor as solids, their shadow and the spring, in any scene.
#pragma once

#include "ui/render/cursor_renderer.h"

namespace marsview {

/// The directions of a cursor, of length 1 and perpendicular to each other, right-handed.
struct CursorAxes {
    Vec3 right{1.0, 0.0, 0.0};
    Vec3 ahead{0.0, 1.0, 0.0};
    Vec3 up{0.0, 0.0, 1.0};
};

/// Every call needs the context current in which it was created, the destructor included. Leaves no
/// program, buffer or vertex array bound.
class CursorSolids {
public:
    static Result<std::unique_ptr<CursorSolids>> create();
    ~CursorSolids();
    CursorSolids(const CursorSolids&) = delete;
    CursorSolids& operator=(const CursorSolids&) = delete;

    /// As CursorRenderer::draw(), with the cursor upright along `axes`.
    void draw(const CursorPicture& cursor,
              const CursorAxes& axes,
              const CameraPose& camera,
              const Viewport& viewport,
              const ClipRange& clip);

private:
    struct Impl;
    explicit CursorSolids(std::unique_ptr<Impl> impl);

    std::unique_ptr<Impl> impl_;
};

/// Where the terrain may hide a cursor, or its shadow.
PixelArea areaOfCursor(const CursorPicture& cursor, const CameraPose& camera, const Viewport& size);

} // namespace marsview
