// Measurements of maps larger than memory. Each runs in a separate process, so that a failed
// measurement does not affect the others and the peak memory of each can be measured.
#pragma once

#include "app/console/map_options.h"
#include "core/base/result.h"
#include "core/levels/tile_heights.h"
#include "core/session/map.h"
#include "core/session/map_resources.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

struct TerrainBenchOptions {
    MapOptions map;
    double seconds = 60.0;                                    // of the swipes at each speed
    std::vector<double> speeds_cells{1.0, 10.0, 50.0, 200.0}; // per update
    std::uint64_t seed = 1;
    std::size_t update_count = 20000; // of the swipes that are not in real time, at each speed
    /// The largest part of the map that is read into memory for comparison.
    std::size_t held_mb_max = 600;
    std::string against;   // a smaller map whose frame times are compared
    int frame_count = 120; // per flight
    bool is_warm = false;  // the first picture uses the system's page cache
};

using BenchJson = nlohmann::ordered_json;

/// Time and memory for preparing the map. Rejects a map that is already prepared.
Result<BenchJson> measurePrepare(const TerrainBenchOptions& options);
/// Time from opening the map to its first picture, as in the window: from the prepared map or,
/// without one, from a preview.
Result<BenchJson> measureFirstPicture(const TerrainBenchOptions& options);
/// Peak memory while flying over and swiping across the map.
Result<BenchJson> measureSession(const TerrainBenchOptions& options);
/// Swipes across cold data in real time, at the servo rate.
Result<BenchJson> measureSwipes(const TerrainBenchOptions& options);
/// The same swipes over tiles and over the map, or its middle, in memory: counts the proxies that
/// differ in any bit.
Result<BenchJson> measureIdentity(const TerrainBenchOptions& options);
/// The cost of an update in the middle of increasingly large parts of the map, warm.
Result<BenchJson> measureGrowth(const TerrainBenchOptions& options);
/// The data downloaded to open a remote map, fly to a place and look at single samples.
Result<BenchJson> measureRemote(const TerrainBenchOptions& options);
/// Frame times while flying over the map, and over another one.
Result<BenchJson> measureFrames(const TerrainBenchOptions& options);

/// The map in tiles, however small it is; prepared first if necessary.
Result<std::shared_ptr<const Map>> openInTiles(const TerrainBenchOptions& options,
                                               JobMonitor& monitor);
/// Resources with which every map is opened in tiles.
MapResources tiledResources();

/// A tiled map for touching.
struct TouchedTiles {
    TiledRaster raster;
    std::shared_ptr<const TileHeights> heights;
    SceneFrame frame;

    std::size_t columns() const { return raster.layout().columns; }
    std::size_t rows() const { return raster.layout().rows; }
};
TouchedTiles touchedTiles(const std::shared_ptr<const Map>& map);

} // namespace marsview
