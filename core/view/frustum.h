// What is in the picture and what is certainly not.
#pragma once

#include "core/view/camera.h"
#include "core/view/scene_box.h"

#include <array>

namespace marsview {

/// The pyramid behind the picture, without near and far end.
class Frustum {
public:
    Frustum(const OrbitCamera& camera, const Viewport& viewport);

    /// True only if no point of the box is in the picture. False for some boxes near the edges that
    /// are not.
    bool isOutside(const SceneBox& box) const noexcept;
    /// True only if every point of the box is in the picture.
    bool isInside(const SceneBox& box) const noexcept;

private:
    ScenePoint eye_;
    std::array<Vec3, 5> inward_; // normals of the four sides, and the view direction
};

} // namespace marsview
