#include "core/view/footprint.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace marsview {
namespace {

// Twice the area, with the sign of the orientation.
double doubledArea(const std::vector<GridPoint>& polygon)
{
    double sum = 0.0;
    const GridPoint origin = polygon.empty() ? GridPoint{} : polygon.front();
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        const GridPoint& a = polygon[i];
        const GridPoint& b = polygon[i + 1];
        sum += (a.column - origin.column) * (b.row - origin.row) -
               (b.column - origin.column) * (a.row - origin.row);
    }
    return sum;
}

// A line in the grid; the positive side, including the line, is kept.
struct Side {
    double column = 0.0;
    double row = 0.0;
    double constant = 0.0;

    double operator()(GridPoint p) const { return column * p.column + row * p.row + constant; }
};

// The intersection of a side of the picture, given by its inward normal, with the level of the
// target. In grid coordinates distances are affine again, so three values determine them.
Side sideOf(const Vec3& inward, const OrbitCamera& camera, const SceneFrame& frame)
{
    const ScenePoint eye = eyeOf(camera);
    const auto distance = [&](GridPoint p) {
        return dot(inward, frame.toScene(p, camera.target.z) - eye);
    };
    const GridPoint origin = frame.origin;
    const double there = distance(origin);
    const Vec3 east_step{frame.east_per_column, frame.north_per_column, 0.0};
    const Vec3 south_step{frame.east_per_row, frame.north_per_row, 0.0};
    const double per_column = dot(inward, east_step);
    const double per_row = dot(inward, south_step);
    return {.column = per_column,
            .row = per_row,
            .constant = there - per_column * origin.column - per_row * origin.row};
}

// Sutherland and Hodgman, "Reentrant polygon clipping", 1974, for one side.
std::vector<GridPoint> cut(const std::vector<GridPoint>& polygon, const Side& side)
{
    std::vector<GridPoint> kept;
    kept.reserve(polygon.size() + 1);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const GridPoint& a = polygon[i];
        const GridPoint& b = polygon[(i + 1) % polygon.size()];
        const double at_a = side(a);
        const double at_b = side(b);
        if (at_a >= 0.0) {
            kept.push_back(a);
        }
        if ((at_a > 0.0 && at_b < 0.0) || (at_a < 0.0 && at_b > 0.0)) {
            const double t = at_a / (at_a - at_b);
            kept.push_back({a.column + (b.column - a.column) * t, a.row + (b.row - a.row) * t});
        }
    }
    return kept;
}

double tangent(const OrbitCamera& camera)
{
    return std::tan(camera.field_of_view.radians() / 2.0);
}

} // namespace

std::vector<GridPoint>
footprint(const OrbitCamera& camera, const Viewport& viewport, const MapPlan& map)
{
    // The picture's four sides are planes through the eye, and points inside all four are in front
    // of it: clipping the map by them needs neither a horizon nor a far plane.
    const CameraAxes axes = axesOf(camera);
    const double up = tangent(camera);
    const double across = up * viewport.aspect();
    const std::array inward{axes.forward * across + axes.right, axes.forward * across - axes.right,
                            axes.forward * up + axes.up, axes.forward * up - axes.up};
    const double last_column = static_cast<double>(map.columns - 1);
    const double last_row = static_cast<double>(map.rows - 1);
    std::vector<GridPoint> polygon{
        {0.0, 0.0}, {last_column, 0.0}, {last_column, last_row}, {0.0, last_row}};
    for (const Vec3& normal : inward) {
        polygon = cut(polygon, sideOf(normalized(normal), camera, map.frame));
    }
    if (polygon.size() < 3 || !(std::abs(doubledArea(polygon)) > 0.0)) {
        return {};
    }
    return polygon;
}

double shareOfMap(const std::vector<GridPoint>& polygon, const MapPlan& map)
{
    const double area = static_cast<double>(map.columns - 1) * static_cast<double>(map.rows - 1);
    return std::min(1.0, std::abs(doubledArea(polygon)) / 2.0 / area);
}

CameraWedge
cameraWedge(const OrbitCamera& camera, const Viewport& viewport, const SceneFrame& frame)
{
    const ScenePoint eye = eyeOf(camera);
    const CameraAxes axes = axesOf(camera);
    // From the eye to the left and right end of the line through the target.
    const Vec3 ahead{axes.forward.x * camera.distance_m, axes.forward.y * camera.distance_m, 0.0};
    const Vec3 aside = axes.right * (tangent(camera) * viewport.aspect() * camera.distance_m);
    return {.eye = frame.toGrid(eye),
            .left = normalized(ahead - aside),
            .right = normalized(ahead + aside),
            .length_m = length(ahead + aside)};
}

} // namespace marsview
