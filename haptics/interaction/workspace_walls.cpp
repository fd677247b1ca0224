#include "haptics/interaction/workspace_walls.h"

#include <algorithm>

namespace marsview {
namespace {

// A device without extent along an axis has no walls there.
double excess(double at, double low, double high) noexcept
{
    return !(low < high) ? 0.0 : at < low ? at - low : at > high ? at - high : 0.0;
}

double shareAt(double at, double low, double high) noexcept
{
    return !(low < high) ? 1.0 : std::clamp(std::min(at - low, high - at) / kWallFadeM, 0.0, 1.0);
}

double shrunk(double low, double high) noexcept
{
    return std::min(kWallFadeM, 0.25 * (high - low));
}

} // namespace

WallContact
wallsAt(const WorkspaceBox& walls, const WorkspacePoint& hand, double stiffness_n_per_m) noexcept
{
    const Vec3 out_m{excess(hand.x, walls.low.x, walls.high.x),
                     excess(hand.y, walls.low.y, walls.high.y), 0.0};
    return {.force_n = out_m * -stiffness_n_per_m,
            .ground_share = std::min(shareAt(hand.x, walls.low.x, walls.high.x),
                                     shareAt(hand.y, walls.low.y, walls.high.y)),
            .penetration_m = length(out_m)};
}

WorkspaceBox reachWithin(const WorkspaceBox& walls) noexcept
{
    const double x_m = shrunk(walls.low.x, walls.high.x);
    const double y_m = shrunk(walls.low.y, walls.high.y);
    return {.low = {walls.low.x + x_m, walls.low.y + y_m, walls.low.z},
            .high = {walls.high.x - x_m, walls.high.y - y_m, walls.high.z}};
}

} // namespace marsview
