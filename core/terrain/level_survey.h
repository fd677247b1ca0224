// The first pass over a map larger than memory: everything but errors.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/raster/tile_source.h"
#include "core/terrain/block_means.h"
#include "core/terrain/level_file_writer.h"
#include "core/terrain/raw_ranges.h"
#include "core/terrain/void_fills.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

namespace marsview {

/// Readers for as many threads as ask, opened when needed. Any thread.
class TileReaders {
public:
    explicit TileReaders(const TileSource& source)
        : source_(source)
    {}

    using Work = std::function<Status(TileReader& reader, std::size_t tile_row)>;
    /// Calls `work` for every row of level-0 tiles, in ascending order as threads get free, until
    /// one fails: its error, or Cancelled.
    Status eachTileRow(const Work& work, std::size_t threads_max, const JobMonitor& monitor);

private:
    const TileSource& source_;
    std::mutex mutex_; // of idle_
    std::vector<std::unique_ptr<TileReader>> idle_;
};

/// The tile, or an error: what reading says, Cancelled, or that the reader gave something else.
Result<Tile>
readTile(TileReader& reader, const TileSource& source, const TileId& id, const JobMonitor& monitor);

/// What the first pass finds.
struct LevelSurvey {
    SampleStatistics statistics;
    RawRanges ranges;
    BlockGrid blocks; // of `kept`; shares only where something is void
    BlockExtent kept; // no larger than a tile, even where that makes too many
    FineMeans fine_means;
    std::vector<std::uint8_t> has_voids;  // by level-0 tile
    std::vector<std::uint32_t> checksums; // of the samples of each tile
    std::optional<SampleGrid> first_rows; // of each row of tiles but the first
    std::optional<SampleGrid> sparse;     // the samples of DetailMeasure::kSparseLevel
    std::vector<FilePart> samples_index;  // of the tiles that were written
};

/// What tells whether a tile is the same when it is read again.
std::uint32_t sampleChecksum(const SampleGrid& samples);

struct SurveyOptions {
    const TileSource* source = nullptr;
    ElevationScale scale;
    std::string path; // of the file that is written; temporary ones lie beside
    std::size_t threads_max = 1;
    std::size_t mean_blocks_max = 4'000'000;
};

/// Reads every tile once and writes those of the nested levels.
Result<LevelSurvey> surveyLevels(const SurveyOptions& options,
                                 TileReaders& readers,
                                 LevelFileWriter& writer,
                                 JobMonitor& monitor);

} // namespace marsview
