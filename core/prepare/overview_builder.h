// The means that become a raster's overviews, taken tile by tile while the raster streams by.
#pragma once

#include "core/raster/sample_grid.h"
#include "core/tiles/tile.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace marsview {

/// Levels of overviews until a single tile is enough: level k has a pixel for every 2^k × 2^k
/// samples.
std::size_t overviewCount(std::size_t columns, std::size_t rows);

/// Takes the raster's tiles, a row of tiles after the other, and gives whole rows of tiles of the
/// levels. A pixel is the mean of the samples of its block that are not void, rounded once (halves
/// away from zero) from sums that are exact for whole numbers of up to 32 bits; it never has the
/// value that stands for void. Blocks of voids alone are void: nodata where there is one, else NaN
/// where the type has it, else 0 under a mask.
///
/// Holds a row of tiles of every level: as much as one of the raster itself.
class OverviewBuilder {
public:
    /// Up to this level a pixel lies within one tile of the raster.
    static constexpr std::size_t kStreamedLevels = 8;

    /// `has_mask`: validity is kept pixel by pixel.
    OverviewBuilder(std::size_t columns,
                    std::size_t rows,
                    SampleType type,
                    const std::optional<double>& nodata,
                    bool has_mask);

    std::size_t levelCount() const noexcept { return levels_.size(); }

    /// Tile (`tile_column`, `tile_row`) of the raster, whose first row is row `grid_row` of `grid`,
    /// which is as wide as the raster. Tiles of one row may be added by several threads at a time.
    void addTile(const SampleGrid& grid,
                 std::size_t grid_row,
                 std::size_t tile_column,
                 std::size_t tile_row);

    /// The row of tiles of a level (1 …) that is complete, or was begun last.
    struct Rows {
        const std::byte* samples = nullptr;  // columns × rows
        const std::uint8_t* valid = nullptr; // 1 or 0 each; null without mask
        std::size_t columns = 0;
        std::size_t rows = 0;
    };
    /// After the tiles of `tile_row`, for 1 <= level <= kStreamedLevels.
    Rows rowsOf(std::size_t level, std::size_t tile_row) const;

    /// After all tiles: a level beyond kStreamedLevels, whole. Ascending, each once.
    Rows makeLevel(std::size_t level);

    /// What has to be kept to go on later behind the first `tile_rows` rows of tiles.
    std::vector<std::uint8_t> save(std::size_t tile_rows) const;
    /// False, changing nothing that matters, where `saved` is not of such a builder.
    bool restore(std::size_t tile_rows, const std::vector<std::uint8_t>& saved);

private:
    struct Level {
        std::size_t columns = 0;
        std::size_t rows = 0;
        std::vector<std::byte> samples; // a row of tiles, or the whole level beyond kStreamedLevels
        std::vector<std::uint8_t> valid;
    };
    template <typename T>
    void addSamples(GridView<const T> samples,
                    const SampleGrid& grid,
                    std::size_t grid_row,
                    std::size_t tile_column,
                    std::size_t tile_row);
    template <typename T, typename Sum>
    void putPixels(Level& level,
                   std::size_t column,
                   std::size_t row,
                   std::size_t width,
                   std::size_t height,
                   const Sum* sums,
                   const std::uint64_t* counts);
    template <typename Function>
    void forEachPending(std::size_t tile_rows, Function&& function);

    SampleType type_;
    std::optional<double> nodata_;
    bool has_mask_;
    std::size_t columns_;
    std::size_t rows_;
    std::size_t tile_columns_;
    std::vector<Level> levels_; // [0] is level 1
    // The blocks of level kStreamedLevels, one a tile of the raster, where coarser levels need
    // them. Sums are whole numbers or doubles, by type.
    std::vector<std::uint64_t> sum_bits_;
    std::vector<std::uint64_t> counts_;
    std::size_t made_level_ = kStreamedLevels;
    std::size_t made_columns_ = 0;
    std::size_t made_rows_ = 0;
};

} // namespace marsview
