// Conservative tests of boxes against the picture.
#pragma once

#include "core/base/oriented_box.h"
#include "core/view/camera.h"
#include "core/view/scene_box.h"

#include <array>

namespace marsview {

/// The view pyramid, or the part of it behind a part of the picture, without near and far planes.
class Frustum {
public:
    Frustum(const CameraPose& camera, const Viewport& viewport)
        : Frustum(camera, viewport, {0, 0, viewport.width, viewport.height})
    {}
    /// Behind a part of the picture.
    Frustum(const CameraPose& camera, const Viewport& viewport, const PixelArea& part);

    /// True only if no point of the box is in the picture. May be false for boxes outside near the
    /// edges.
    bool isOutside(const SceneBox& box) const noexcept;
    /// True only if every point of the box is in the picture.
    bool isInside(const SceneBox& box) const noexcept;
    /// The same for a box in any direction.
    bool isOutside(const OrientedBox& box) const noexcept;
    bool isInside(const OrientedBox& box) const noexcept;

private:
    ScenePoint eye_;
    std::array<Vec3, 5> inward_; // normals of the four sides, and the view direction
};

} // namespace marsview
