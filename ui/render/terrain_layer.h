// A map as input of the renderer.
#pragma once

#include "core/body/body_grid.h"
#include "core/geo/scene_frame.h"
#include "core/session/map.h"
#include "core/terrain/heightfield.h"
#include "core/terrain/surface_analysis.h"
#include "core/view/color_ramp.h"

#include <memory>

namespace marsview {

/// One map in the scene. Copies share the large members.
struct TerrainLayer {
    std::shared_ptr<const Heightfield> heightfield;
    std::shared_ptr<const SurfaceAnalysis> analysis; // of heightfield
    SceneFrame frame;                                // from its grid to the scene
    const ColorRamp* ramp = nullptr;                 // static data
    HeightRange tint_range; // over which the ramp is spread: all but the rarest heights
    SlopeRange slope_range; // over which it is spread where it shows slopes
    double slope_max = 1.0; // that relief tiles are made for
    std::shared_ptr<const ReliefTile> relief; // of the whole map
    std::shared_ptr<const BodyGrid> body{};   // on its body; null in the flat scene
};

/// The layer of a map that lies in the scene as `frame` says.
inline TerrainLayer
terrainLayer(const std::shared_ptr<const Map>& map, const SceneFrame& frame, const ColorRamp& ramp)
{
    return {.heightfield = {map, &map->heightfield()},
            .analysis = map->analysis(),
            .frame = frame,
            .ramp = &ramp,
            .tint_range = tintedRange(ramp, map->tintRange()),
            .slope_range = map->slopeRange(),
            .slope_max = map->slopeMax(),
            .relief = map->relief()};
}

} // namespace marsview
