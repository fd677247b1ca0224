// Gathering the samples of coarser levels from tiles of the finest.
#pragma once

#include "core/prepare/checkpoint_file.h"
#include "core/raster/sample_grid.h"
#include "core/tiles/tile.h"

#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace marsview {

/// A row of tiles of a level: kTileSide rows of samples, or what is left, of all columns.
struct LevelBand {
    std::size_t level = 0;
    std::size_t tile_row = 0;
    SampleGrid samples;
};

/// Takes level-0 tiles in any order and gives bands of the levels as they are complete. Holds the
/// bands that were begun: few, where tiles come about row by row. Any thread.
class NestedLevels {
public:
    /// Levels first … last. Samples of `type`; those that nobody sets are 0.
    NestedLevels(const TileLayout& layout, SampleType type, std::size_t first, std::size_t last);

    /// Puts the tile's samples where they belong, with their voids. Null: there is nothing in this
    /// tile. Returns what is complete with it.
    std::vector<LevelBand> add(const TileId& id, const SampleGrid* samples);

    /// The bands that were begun. While nobody adds.
    void save(CheckpointWriter& to) const;
    bool restore(CheckpointReader& from);

private:
    struct Band {
        std::optional<SampleGrid> samples; // none before the first that is something
        std::size_t missing = 0;           // samples
    };

    std::mutex mutex_; // of bands_
    TileLayout layout_;
    SampleType type_;
    std::size_t first_;
    std::size_t last_;
    std::map<std::pair<std::size_t, std::size_t>, Band> bands_; // by level and row of tiles
};

/// The samples [first_column, first_column + columns) of all rows of a grid.
SampleGrid columnsOf(const SampleGrid& samples, std::size_t first_column, std::size_t columns);

} // namespace marsview
