#include "core/view/frustum.h"

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

// The distance inside a plane through the eye of a box's innermost corner.
double furthestInside(const Vec3& low, const Vec3& high, const Vec3& inward)
{
    return dot({inward.x > 0.0 ? high.x : low.x, inward.y > 0.0 ? high.y : low.y,
                inward.z > 0.0 ? high.z : low.z},
               inward);
}

} // namespace

Frustum::Frustum(const CameraPose& camera, const Viewport& viewport, const PixelArea& part)
    : eye_(camera.eye)
{
    const CameraAxes& axes = camera.axes;
    const double half_height = std::tan(camera.field_of_view.radians() / 2.0);
    const double half_width = half_height * viewport.aspect();
    // Of the part's sides, at a depth of 1.
    const auto across = [&](int x) { return half_width * (2.0 * x / viewport.width - 1.0); };
    const auto upward = [&](int y) { return half_height * (2.0 * y / viewport.height - 1.0); };
    inward_ = {axes.forward * across(part.left + part.width) - axes.right,
               axes.right - axes.forward * across(part.left),
               axes.forward * upward(part.bottom + part.height) - axes.up,
               axes.up - axes.forward * upward(part.bottom), axes.forward};
}

bool Frustum::isOutside(const SceneBox& box) const noexcept
{
    const Vec3 low = box.minimum - eye_;
    const Vec3 high = box.maximum - eye_;
    return std::any_of(inward_.begin(), inward_.end(),
                       [&](const Vec3& n) { return furthestInside(low, high, n) < 0.0; });
}

bool Frustum::isInside(const SceneBox& box) const noexcept
{
    const Vec3 low = box.minimum - eye_;
    const Vec3 high = box.maximum - eye_;
    // For the mirrored box, the innermost corner is the outermost.
    return std::all_of(inward_.begin(), inward_.end(),
                       [&](const Vec3& n) { return furthestInside(high, low, n) >= 0.0; });
}

bool Frustum::isOutside(const OrientedBox& box) const noexcept
{
    const Vec3 middle = box.center - eye_;
    return std::any_of(inward_.begin(), inward_.end(),
                       [&](const Vec3& n) { return dot(middle, n) + box.reachAlong(n) < 0.0; });
}

bool Frustum::isInside(const OrientedBox& box) const noexcept
{
    const Vec3 middle = box.center - eye_;
    return std::all_of(inward_.begin(), inward_.end(),
                       [&](const Vec3& n) { return dot(middle, n) - box.reachAlong(n) >= 0.0; });
}

} // namespace marsview
