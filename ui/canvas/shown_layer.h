// A map as the view is given it.
#pragma once

#include "core/session/map.h"
#include "core/view/color_ramp.h"
#include "ui/render/terrain_layer.h"

#include <cstddef>
#include <memory>
#include <optional>

namespace marsview {

struct ShownLayer {
    std::shared_ptr<const Map> map;
    const ColorRamp* ramp = nullptr; // one of colorRamps(); never null
    /// Over which elevations the ramp is spread; nothing for what suits the map.
    std::optional<HeightRange> color_range{};
    std::optional<SlopeRange> slope_range{}; // the same for slopes
    std::size_t feather_cells = 0;           // as in Layer; on the globe only
};

/// The elevations at the ends of the layer's ramp.
inline HeightRange colorRangeOf(const ShownLayer& layer)
{
    return tintedRange(*layer.ramp, layer.color_range.value_or(layer.map->tintRange()));
}

/// The slopes there in the mode Slope.
inline SlopeRange slopeRangeOf(const ShownLayer& layer)
{
    return layer.slope_range.value_or(layer.map->slopeRange());
}

/// As it is drawn where its grid lies in the scene as `frame` says.
inline TerrainLayer terrainLayer(const ShownLayer& layer, const SceneFrame& frame)
{
    TerrainLayer drawn = terrainLayer(layer.map, frame, *layer.ramp);
    drawn.tint_range = colorRangeOf(layer);
    drawn.slope_range = slopeRangeOf(layer);
    return drawn;
}

} // namespace marsview
