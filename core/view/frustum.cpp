#include "core/view/frustum.h"

#include <algorithm>
#include <cmath>

namespace marsview {

Frustum::Frustum(const OrbitCamera& camera, const Viewport& viewport)
    : eye_(eyeOf(camera))
{
    const CameraAxes axes = axesOf(camera);
    const double up = std::tan(camera.field_of_view.radians() / 2.0);
    const double right = up * viewport.aspect();
    inward_ = {axes.forward * right - axes.right, axes.forward * right + axes.right,
               axes.forward * up - axes.up, axes.forward * up + axes.up, axes.forward};
}

bool Frustum::isOutside(const SceneBox& box) const noexcept
{
    const Vec3 low = box.minimum - eye_;
    const Vec3 high = box.maximum - eye_;
    return std::any_of(inward_.begin(), inward_.end(), [&](const Vec3& n) {
        // The corner furthest inside.
        const Vec3 corner{n.x > 0.0 ? high.x : low.x, n.y > 0.0 ? high.y : low.y,
                          n.z > 0.0 ? high.z : low.z};
        return dot(corner, n) < 0.0;
    });
}

} // namespace marsview
