// What is measured of maps that are larger than memory, each in a process of its own, so that one
// that cannot be measured leaves the others alone, and the most memory that it held is its own.
#pragma once

#include "app/console/map_options.h"
#include "core/base/result.h"
#include "core/levels/tile_heights.h"
#include "core/session/map.h"
#include "core/session/open_map.h"

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
    double seconds = 60.0;                                    // of the swipes at a speed
    std::vector<double> speeds_cells{1.0, 10.0, 50.0, 200.0}; // an update
    std::uint64_t seed = 1;
    std::size_t update_count = 20000; // of the swipes that are not in real time, at a speed
    /// The largest part of the map that is held in memory to be compared with.
    std::size_t held_mb_max = 600;
    std::string against;   // a smaller map, whose frames are compared with
    int frame_count = 120; // of a flight
    bool is_warm = false;  // the first picture is drawn from what the system has in memory
};

using BenchJson = nlohmann::ordered_json;

/// How long it takes to make what opening the map needs, and how much memory. Refuses a map that
/// is prepared already.
Result<BenchJson> measurePrepare(const TerrainBenchOptions& options);
/// From opening the map to its first picture, as the program does it: prepared or, where it is
/// not, a preview of it.
Result<BenchJson> measureFirstPicture(const TerrainBenchOptions& options);
/// The most memory that is held while the map is flown over and swiped across.
Result<BenchJson> measureSession(const TerrainBenchOptions& options);
/// Swipes across cold data at the real rate of the servo.
Result<BenchJson> measureSwipes(const TerrainBenchOptions& options);
/// The same swipes over tiles and over the map, or its middle, held in memory: how many proxies
/// differ in any bit.
Result<BenchJson> measureIdentity(const TerrainBenchOptions& options);
/// What an update costs in the middle of ever larger parts of the map, warm.
Result<BenchJson> measureGrowth(const TerrainBenchOptions& options);
/// What is fetched of a map by address to open it, fly to a place and look at single samples.
Result<BenchJson> measureRemote(const TerrainBenchOptions& options);
/// Times of frames while flying over the map, and over another.
Result<BenchJson> measureFrames(const TerrainBenchOptions& options);

/// The map in tiles however small it is, prepared first where it has to be.
Result<std::shared_ptr<const Map>> openInTiles(const TerrainBenchOptions& options,
                                               JobMonitor& monitor);
/// Resources by which every map comes in tiles.
MapResources tiledResources();

/// A map in tiles as a hand touches it.
struct TouchedTiles {
    TiledRaster raster;
    std::shared_ptr<const TileHeights> heights;
    SceneFrame frame;

    std::size_t columns() const { return raster.layout().columns; }
    std::size_t rows() const { return raster.layout().rows; }
};
TouchedTiles touchedTiles(const std::shared_ptr<const Map>& map);

} // namespace marsview
