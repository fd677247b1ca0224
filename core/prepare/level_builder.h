// Writing the level file of a tiled raster.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/levels/level_file.h"
#include "core/tiles/tile_source.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace marsview {

struct LevelBuild {
    const TileSource* source = nullptr; // level 0 is read, in bands of whole rows of tiles
    ElevationScale scale;
    LevelFileKey key;
    std::string path; // written beside itself and moved there when whole
    std::size_t memory_bytes_max = std::size_t{1} << 30; // fewer threads work where it is little
    /// The means of no more blocks than this are kept: those of blocks of 8 samples a side, or
    /// twice as many until they are few enough.
    std::size_t mean_blocks_max = 4'000'000;
    /// Asked when all is written, before anybody can see it: an error is that of the build.
    std::function<Status()> confirm{};
    /// How far a build that is stopped may fall back; more where saving takes long.
    std::chrono::milliseconds checkpoint_interval{3'000};
};

/// No level file of such a raster takes more bytes on the disk while it is made.
std::uint64_t levelFileBytesMax(const TileLayout& layout,
                                std::size_t mean_blocks_max = LevelBuild{}.mean_blocks_max);

/// Looks for room on the disk beforehand.
/// Reads the raster twice, on all cores, and writes its level file. What was at `path` before stays
/// when it fails: when cancelled, when a tile cannot be read, when the disk is full. Stopped by one
/// of these, or by the death of the program, the next call for the same build goes on from the last
/// checkpoint; before the first, nothing is left behind.
Status buildLevelFile(const LevelBuild& build, JobMonitor& monitor);

} // namespace marsview
