// A part of a map in memory, for comparison with tiled maps.
#pragma once

#include "app/console/map_options.h"
#include "core/base/job_monitor.h"
#include "core/geo/scene_frame.h"
#include "core/levels/tile_heights.h"
#include "core/raster/raster_file.h"
#include "core/terrain/filled_heightfield.h"
#include "core/tiles/tile_source.h"

#include <cstddef>
#include <memory>
#include <string>

namespace marsview {

/// Samples and the data needed to touch them. Copies share; any thread.
struct HeldMap {
    std::shared_ptr<const FilledHeightfield> filled;
    std::shared_ptr<const SurfaceAnalysis> analysis;
    SampleStatistics statistics;
    SceneFrame frame;  // of the whole map, so that coordinates are the same in every part
    GridWindow window; // of the whole map

    std::uint64_t triangleCount() const noexcept
    {
        return std::uint64_t{2} * (window.columns - 1) * (window.rows - 1);
    }
};

/// Reads and analyzes a window of the map: at least 2 × 2 samples, not all of them void.
Result<HeldMap>
holdWindow(const MapOptions& options, const GridWindow& window, JobMonitor& monitor);

/// The window of `columns` × `rows` samples in the middle of the map, smaller if the map is
/// smaller.
GridWindow
middleOf(std::size_t map_columns, std::size_t map_rows, std::size_t columns, std::size_t rows);

/// Tiles of the samples at full resolution and at all coarser levels. Shares the map.
std::shared_ptr<const TileSource> tilesOf(const HeldMap& map);
/// The metadata needed to read these tiles.
std::shared_ptr<const TileHeights> tileHeightsOf(const HeldMap& map);

} // namespace marsview
