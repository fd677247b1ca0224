// The first pass over a map larger than memory: everything except errors.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/prepare/checkpoint_file.h"
#include "core/prepare/level_file_writer.h"
#include "core/prepare/nested_levels.h"
#include "core/prepare/ordered_tiles.h"
#include "core/prepare/tile_counts.h"
#include "core/prepare/void_fills.h"
#include "core/terrain/block_means.h"
#include "core/terrain/raw_ranges.h"
#include "core/tiles/tile_checksums.h"
#include "core/tiles/tile_source.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace marsview {

/// The results of the first pass. If it was made over some rows only, those of the others are not
/// set.
struct LevelSurvey {
    SampleStatistics statistics;
    RawRanges ranges;
    BlockGrid blocks; // of `kept`; shares only if there are voids
    BlockExtent kept; // no larger than a tile, even if that gives too many
    FineMeans fine_means;
    std::vector<std::uint8_t> has_voids; // by level-0 tile
    std::shared_ptr<TileChecksums> checksums;
    std::optional<SampleGrid> first_rows; // of each row of tiles except the first
    std::optional<SampleGrid> sparse;     // the samples of DetailMeasure::kSparseLevel
    std::vector<FilePart> samples_index;  // of the tiles that were written
};

struct SurveyOptions {
    const TileSource* source = nullptr;
    ElevationScale scale;
    std::string means_path; // of the file of FineMeans; empty: the means of parts are added
    std::size_t mean_blocks_max = 4'000'000;
    TileRowRange rows{};                   // that are surveyed; the memory of others is not touched
    const ScratchPlace* scratch = nullptr; // where large bands of levels lie
};

/// The first pass. Any threads may process rows; everything else is for one thread.
class LevelSurveyPass {
public:
    /// With a null `writer`, the levels are not stored.
    LevelSurveyPass(const SurveyOptions& options, LevelFileWriter* writer, JobMonitor& monitor);
    ~LevelSurveyPass();
    LevelSurveyPass(const LevelSurveyPass&) = delete;
    LevelSurveyPass& operator=(const LevelSurveyPass&) = delete;

    /// Call before any row to start from the beginning.
    Status begin();
    /// Call instead of begin() if some rows are done. False if `from` is not from save() for such a
    /// map.
    bool restore(CheckpointReader& from);
    /// Writes the results of the completed rows; also after finish(). False if data could not be
    /// flushed to the disk.
    bool save(CheckpointWriter& to) const;

    /// Measures everything except errors for a row of level-0 tiles, and its part of the levels.
    Status surveyRow(TileReader& reader, std::size_t tile_row);
    /// The number of rows of tiles of means, over all levels.
    std::size_t meanRowCount() const;
    /// Computes the checksums of one of them.
    Status surveyMeanRow(TileReader& reader, std::size_t row);

    /// Call when all rows are done. The statistics include those that State::found had before.
    const LevelSurvey& finish();

    /// The state of the pass, to be divided between parts of a map and merged again. While no row
    /// is being processed.
    struct State {
        LevelSurvey& found;
        NestedLevels& nested; // bands that are not complete
        OrderedTiles& ordered;
        std::atomic<std::uint64_t>& void_count;
    };
    State state();
    /// Stores a band that another part completed.
    Status keepBand(const LevelBand& band);

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace marsview
