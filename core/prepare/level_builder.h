// Builds the level file of a tiled raster.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/levels/level_file.h"
#include "core/tiles/tile_source.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>

namespace marsview {

class LevelErrorPass;
class LevelFileWriter;
struct LevelSurvey;

struct LevelBuild {
    const TileSource* source = nullptr; // its level 0 is read in rows of tiles
    ElevationScale scale;
    LevelFileKey key;
    std::string path; // written to a temporary file and renamed when complete
    std::size_t memory_bytes_max = std::size_t{1} << 30; // with little memory, fewer threads work
    /// The maximum number of block means to store: blocks have 8 samples a side, doubled until the
    /// number fits.
    std::size_t mean_blocks_max = 4'000'000;
    /// Called when everything is written, before the file is published: its error becomes that of
    /// the build.
    std::function<Status()> confirm{};
    /// The work that an interruption may lose; more if saving takes long.
    std::chrono::milliseconds checkpoint_interval{3'000};
};

/// The number of threads that measure such a raster within so much memory, if a thread's bands of
/// levels need no more than `band_bytes_max`; at least 1.
std::size_t levelThreads(const TileLayout& layout,
                         std::size_t memory_bytes_max = LevelBuild{}.memory_bytes_max,
                         std::size_t band_bytes_max = std::numeric_limits<std::size_t>::max());

/// What a level file says of its raster.
struct LevelFileOf {
    LevelFileKey key;
    TileLayout layout;
    ElevationScale scale;
    std::size_t mean_blocks_max = LevelBuild{}.mean_blocks_max;
    std::function<Status()> confirm{}; // as in LevelBuild
};

/// Writes the results of both passes after their tiles, and publishes the file.
Status finishLevelFile(const LevelFileOf& file,
                       const LevelSurvey& survey,
                       LevelErrorPass& errors,
                       LevelFileWriter& writer,
                       JobMonitor& monitor);

/// An upper bound on the disk space used while building the level file of such a raster.
std::uint64_t levelFileBytesMax(const TileLayout& layout,
                                std::size_t mean_blocks_max = LevelBuild{}.mean_blocks_max);

/// Checks for free disk space, reads the raster twice, on all cores, and writes its level file. On
/// failure an existing file at `path` is kept. After a cancel, a read error, a full disk or a
/// crash, the next call for the same build resumes from the last checkpoint. A failure before the
/// first checkpoint leaves no files.
Status buildLevelFile(const LevelBuild& build, JobMonitor& monitor);

} // namespace marsview
