// The first pass over a map larger than memory: everything but errors.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/prepare/checkpoint_file.h"
#include "core/prepare/level_file_writer.h"
#include "core/prepare/void_fills.h"
#include "core/terrain/block_means.h"
#include "core/terrain/raw_ranges.h"
#include "core/tiles/tile_checksums.h"
#include "core/tiles/tile_source.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace marsview {

/// What the first pass finds.
struct LevelSurvey {
    SampleStatistics statistics;
    RawRanges ranges;
    BlockGrid blocks; // of `kept`; shares only where something is void
    BlockExtent kept; // no larger than a tile, even where that makes too many
    FineMeans fine_means;
    std::vector<std::uint8_t> has_voids; // by level-0 tile
    std::shared_ptr<TileChecksums> checksums;
    std::optional<SampleGrid> first_rows; // of each row of tiles but the first
    std::optional<SampleGrid> sparse;     // the samples of DetailMeasure::kSparseLevel
    std::vector<FilePart> samples_index;  // of the tiles that were written
};

struct SurveyOptions {
    const TileSource* source = nullptr;
    ElevationScale scale;
    std::string means_path; // of the file that FineMeans needs meanwhile
    std::size_t mean_blocks_max = 4'000'000;
};

/// The first pass. Its rows are worked on by any threads; all else by one, meanwhile.
class LevelSurveyPass {
public:
    LevelSurveyPass(const SurveyOptions& options, LevelFileWriter& writer, JobMonitor& monitor);
    ~LevelSurveyPass();
    LevelSurveyPass(const LevelSurveyPass&) = delete;
    LevelSurveyPass& operator=(const LevelSurveyPass&) = delete;

    /// Before any row, of a map of which nothing is known yet.
    Status begin();
    /// Instead, of a map of which some rows are done. False where it is not what save() wrote of
    /// such a map.
    bool restore(CheckpointReader& from);
    /// What the rows that are done have given; also after finish(). False where it is not safe.
    bool save(CheckpointWriter& to) const;

    /// All but errors of a row of level-0 tiles, and its part of the levels.
    Status surveyRow(TileReader& reader, std::size_t tile_row);
    /// Rows of tiles of means, of all levels.
    std::size_t meanRowCount() const;
    /// Takes the checksums of one of them.
    Status surveyMeanRow(TileReader& reader, std::size_t row);

    /// When all rows are done.
    const LevelSurvey& finish();

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace marsview
