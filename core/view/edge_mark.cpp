#include "core/view/edge_mark.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace marsview {
namespace {

// A point nearer to the view axis than this fraction of its distance counts as on the axis.
constexpr double kStraightShare = 1e-9;

bool isInside(const PixelPoint& pixel, const EdgeLine& line)
{
    return pixel.x >= 0.0 && pixel.x <= line.viewport.width && pixel.y >= line.covered_px &&
           pixel.y <= line.viewport.height;
}

// The number of steps of `step` from `from` to the end of the range on that side.
double stepsToEnd(double from, double step, double low, double high)
{
    if (step == 0.0) {
        return std::numeric_limits<double>::infinity();
    }
    return std::max(0.0, ((step > 0.0 ? high : low) - from) / step);
}

} // namespace

std::optional<EdgeMark>
edgeMark(const CameraPose& camera, const ScenePoint& place, const EdgeLine& line)
{
    const auto pixel = project(camera, line.viewport, place);
    if (pixel && isInside(*pixel, line)) {
        return std::nullopt;
    }
    // Perpendicular to the view axis, the point lies on the same side in front of the eye and
    // behind it.
    const CameraAxes& axes = camera.axes;
    const Vec3 way = place - camera.eye;
    double right = dot(way, axes.right);
    double down = -dot(way, axes.up);
    const double across = std::hypot(right, down);
    if (across > kStraightShare * length(way)) {
        right /= across;
        down /= across;
    } else {
        right = 0.0;
        down = 1.0;
    }
    const double width = line.viewport.width;
    const double height = line.viewport.height;
    const auto within = [](double value, double low, double high) {
        return low <= high ? std::clamp(value, low, high) : (low + high) / 2.0;
    };
    const double left_end = line.inset_px;
    const double right_end = width - line.inset_px;
    const double top_end = line.covered_px + line.inset_px;
    const double bottom_end = height - line.inset_px;
    const double steps = std::min(stepsToEnd(width / 2.0, right, left_end, right_end),
                                  stepsToEnd(height / 2.0, down, top_end, bottom_end));
    return EdgeMark{.at = {within(width / 2.0 + steps * right, left_end, right_end),
                           within(height / 2.0 + steps * down, top_end, bottom_end)},
                    .right = right,
                    .down = down};
}

} // namespace marsview
