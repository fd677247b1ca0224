#include "core/globe/horizon.h"

#include <algorithm>

namespace marsview {
namespace {

// The region behind a sphere is convex: within the cone of tangents through the eye, beyond the
// plane in which they touch.
class Shadow {
public:
    Shadow(const Vec3& eye, double radius_square)
        : eye_(eye)
        , tangent_square_(dot(eye, eye) - radius_square)
    {}

    bool has(const Vec3& point) const noexcept
    {
        const Vec3 way = point - eye_;
        const double toward = -dot(way, eye_);
        return tangent_square_ > 0.0 && toward > tangent_square_ &&
               toward * toward > tangent_square_ * dot(way, way);
    }

private:
    Vec3 eye_;
    double tangent_square_; // of the length of a tangent
};

Vec3 scaled(const Vec3& point, double polar_scale)
{
    return {point.x, point.y, point.z * polar_scale};
}

} // namespace

Horizon::Horizon(const Ellipsoid& ellipsoid, double lowest_m)
    : polar_scale_(ellipsoid.equatorial_m / ellipsoid.polar_m)
{
    const double depth_m = std::max(-lowest_m, 0.0) * std::max(polar_scale_, 1.0);
    const double radius_m = std::max(ellipsoid.equatorial_m - depth_m, 0.0);
    radius_square_ = radius_m * radius_m;
}

bool Horizon::hides(const OrientedBox& box, const ScenePoint& eye) const noexcept
{
    const Shadow shadow(scaled(eye, polar_scale_), radius_square_);
    const auto corners = box.corners();
    return std::all_of(corners.begin(), corners.end(), [&](const ScenePoint& corner) {
        return shadow.has(scaled(corner, polar_scale_));
    });
}

bool Horizon::hides(const ScenePoint& point, const ScenePoint& eye) const noexcept
{
    return Shadow(scaled(eye, polar_scale_), radius_square_).has(scaled(point, polar_scale_));
}

} // namespace marsview
