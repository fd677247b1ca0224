// Collects the samples of coarser levels from tiles of the finest.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/prepare/checkpoint_file.h"
#include "core/raster/sample_grid.h"
#include "core/tiles/tile.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace marsview {

/// Wide bands are released after so many of their tiles, and after so many level-0 tiles.
inline constexpr std::size_t kTilesPerRelease = 64;

/// A row of tiles of a level: kTileSide rows of samples, or fewer at the end, with all columns.
struct LevelBand {
    std::size_t level = 0;
    std::size_t tile_row = 0;
    SampleGrid samples;
};

/// Takes level-0 tiles in any order and returns bands of the levels as they become complete.
/// Incomplete bands stay in memory: few if tiles arrive roughly row by row. Any thread.
class NestedLevels {
public:
    /// Levels first … last. Samples of `type`; samples that are not set are 0. Large bands lie
    /// where `scratch` says, which outlives the object.
    NestedLevels(const TileLayout& layout,
                 SampleType type,
                 std::size_t first,
                 std::size_t last,
                 const ScratchPlace* scratch = nullptr);

    /// Copies the tile's samples and voids into the bands. Null means an empty tile. Returns the
    /// bands that this tile completes. TooLarge if there is no room for a band.
    Result<std::vector<LevelBand>> add(const TileId& id, const SampleGrid* samples);
    /// Releases all bands, as ScratchBytes::release().
    void release();

    /// Writes the incomplete bands. Do not call during add().
    void save(CheckpointWriter& to) const;
    bool restore(CheckpointReader& from);

    /// Adds the incomplete bands of another part of the map, whose rows of level-0 tiles are
    /// [first, end), and returns those that it completes. Empty if `from` is not from save() for
    /// such a map.
    std::optional<std::vector<LevelBand>>
    merge(CheckpointReader& from, std::size_t first, std::size_t end);

private:
    struct Band {
        std::optional<SampleGrid> samples; // empty before the first nonempty tile
        std::size_t missing = 0;           // samples
    };

    struct SavedBand {
        std::size_t level = 0;
        std::size_t tile_row = 0;
        Band band;
    };
    Result<SampleGrid> zeros(std::size_t columns, std::size_t rows) const;
    std::optional<SavedBand> readBand(CheckpointReader& from) const;
    std::size_t bandRows(std::size_t level, std::size_t tile_row) const
    {
        return std::min(kTileSide, layout_.rowsAt(TileKind::Samples, level) - tile_row * kTileSide);
    }

    std::mutex mutex_; // guards bands_
    TileLayout layout_;
    SampleType type_;
    std::size_t first_;
    std::size_t last_;
    const ScratchPlace* scratch_;
    std::map<std::pair<std::size_t, std::size_t>, Band> bands_; // by level and row of tiles
};

/// Passes the tiles of a band on, from the left. Errors: Canceled.
Status forEachTile(const LevelBand& band,
                   const TileLayout& layout,
                   const JobMonitor& monitor,
                   const std::function<void(const TileId& id, const SampleGrid& tile)>& take);

} // namespace marsview
