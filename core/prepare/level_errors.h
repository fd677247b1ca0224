// The second pass over a map larger than memory: errors and fills of voids.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/large_vector.h"
#include "core/base/result.h"
#include "core/prepare/checkpoint_file.h"
#include "core/prepare/level_file_writer.h"
#include "core/prepare/level_survey.h"
#include "core/prepare/nested_levels.h"
#include "core/prepare/ordered_tiles.h"
#include "core/prepare/tile_counts.h"
#include "core/terrain/detail_errors.h"
#include "core/tiles/tile_source.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace marsview {

/// Some tiles of a map, by number, and their locations in the file. Any thread.
class TileParts {
public:
    void add(std::uint64_t number, const FilePart& part)
    {
        const std::lock_guard lock(mutex_);
        parts_.emplace_back(number, part);
    }
    std::size_t size() const { return parts_.size(); }
    /// The plane of the file, in ascending order: four rows.
    std::vector<std::uint64_t> index() const;
    bool restore(std::vector<std::uint64_t> index);

private:
    std::mutex mutex_;
    std::vector<std::pair<std::uint64_t, FilePart>> parts_;
};

/// The results of the second pass.
struct LevelErrors {
    DetailErrors errors;
    LargeVector<float> fills_m; // the plane "fills"
};

/// A row of LevelSurvey::sparse, and the distance of the columns that are needed of it; its last
/// column is always one of them.
struct SparseRow {
    std::size_t row = 0;
    std::size_t column_step = 1;
};

/// The levels from this one on have cells that are taller than a tile.
inline constexpr std::size_t kTallLevel = 9;

/// What the second pass over some rows of tiles needs of LevelSurvey::sparse, in ascending order:
/// the samples in these rows and on their lower side, and the vertices of kTallLevel in the cells
/// that reach farther.
std::vector<SparseRow> sparseRowsFor(const TileLayout& layout, const TileRowRange& rows);

/// The second pass. Any threads may process rows; everything else is for one thread.
class LevelErrorPass {
public:
    /// With a null `writer`, fills are not stored. Only `rows` will be measured; the survey then
    /// has these rows, the first one after them, and sparseRowsFor() them. Large bands of fills lie
    /// where `scratch` says.
    LevelErrorPass(const TileSource& source,
                   const ElevationScale& scale,
                   const LevelSurvey& survey,
                   LevelFileWriter* writer,
                   JobMonitor& monitor,
                   const TileRowRange& rows = {},
                   const ScratchPlace* scratch = nullptr);
    ~LevelErrorPass();
    LevelErrorPass(const LevelErrorPass&) = delete;
    LevelErrorPass& operator=(const LevelErrorPass&) = delete;

    /// Call first.
    Status begin();
    /// Call next if some rows are done already, with the state from save().
    bool restore(CheckpointReader& from);
    void save(CheckpointWriter& to) const;

    /// Compares the samples of a row of level-0 tiles with every level.
    Status measureRow(TileReader& reader, std::size_t tile_row);

    /// Call once, when all rows are done.
    LevelErrors finish();
    /// Tiles with voids at level 0 and at the stored levels.
    const TileParts& tileFills() const;
    const TileParts& coarseFills() const;

    /// The state of the pass, to be divided between parts of a map and merged again. While no row
    /// is being processed.
    struct State {
        DetailErrors::NodeErrors& errors;
        LargeVector<float>& fills_m; // as in LevelErrors
        NestedLevels& coarse_fills;  // bands that are not complete
        TileParts& tile_fill_parts;
        TileParts& coarse_fill_parts;
        OrderedTiles& ordered;
    };
    State state();
    /// Stores a band of fills that another part completed.
    Status keepCoarseFills(const LevelBand& band);

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace marsview
