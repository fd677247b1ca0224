// Where a simulated hand strokes so that it stays in the picture.
#pragma once

#include "core/view/camera.h"
#include "haptics/device/workspace.h"

#include <functional>
#include <optional>

namespace marsview {

/// Where the terrain straight below or above a point of the workspace is in the picture, or beside
/// it; empty without terrain, or where it cannot be seen.
using TerrainPixel = std::function<std::optional<PixelPoint>(const WorkspacePoint&)>;

/// The rectangle of the workspace, level and within `reach`, above which all of the terrain lies
/// well inside the picture and takes up most of it. Empty if hardly any terrain is in it.
std::optional<WorkspaceBox>
strokeArea(const WorkspaceBox& reach, const Viewport& viewport, const TerrainPixel& pixel_at);

/// The highest terrain in a rectangle of the workspace, in workspace meters; the rectangle's lower
/// side if there is none. `height_at` is the terrain's height there; NaN without terrain.
double highestIn(const WorkspaceBox& rectangle,
                 const std::function<double(const WorkspacePoint&)>& height_at);

} // namespace marsview
