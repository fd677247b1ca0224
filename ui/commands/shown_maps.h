// The maps of the scene that is shown.
#pragma once

#include "core/session/map.h"

#include <memory>
#include <optional>
#include <vector>

namespace marsview {

class GlobeView;
class TerrainView;

/// On the flat map or on the globe, the uppermost first.
std::vector<std::shared_ptr<const Map>> shownMaps(const TerrainView& view, const GlobeView& globe);

/// Where a position on the grid of a map of the scene is on the topmost map's grid, which may be
/// beyond its samples; nothing outside its projection.
std::optional<GridPoint> onTopmost(const TerrainView& view, const Map& map, GridPoint grid);

} // namespace marsview
