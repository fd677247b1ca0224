// Computes a raster's overviews as means, tile by tile, in a single pass.
#pragma once

#include "core/base/large_vector.h"
#include "core/base/scratch_bytes.h"
#include "core/raster/sample_grid.h"
#include "core/tiles/tile.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace marsview {

/// The number of overview levels until a single tile is enough: level k has a pixel for every 2^k ×
/// 2^k samples.
std::size_t overviewCount(std::size_t columns, std::size_t rows);

/// Takes the raster's tiles row by row and returns complete rows of tiles of the levels. A pixel is
/// the mean of the valid samples of its block, rounded once (halves away from zero) from sums that
/// are exact for integers of up to 32 bits; it never equals the nodata value. Blocks without valid
/// samples are void: nodata if declared, otherwise NaN if the type has it, otherwise 0 under a
/// mask.
///
/// Memory: one row of tiles of every level, together as much as one row of the raster's tiles.
class OverviewBuilder {
public:
    /// Up to this level a pixel lies within one tile of the raster.
    static constexpr std::size_t kStreamedLevels = 8;

    /// `has_mask`: validity is stored for each pixel.
    OverviewBuilder(std::size_t columns,
                    std::size_t rows,
                    SampleType type,
                    const std::optional<double>& nodata,
                    bool has_mask);

    std::size_t levelCount() const noexcept { return levels_.size(); }

    /// Call before addTile(). Makes room for a row of tiles of every level; a large one lies where
    /// `scratch` says.
    Status makeRoom(const ScratchPlace* scratch = nullptr);

    /// Tile (`tile_column`, `tile_row`) of the raster, whose first row is row `grid_row` of `grid`,
    /// which is as wide as the raster. Several threads may add tiles of one row at the same time.
    void addTile(const SampleGrid& grid,
                 std::size_t grid_row,
                 std::size_t tile_column,
                 std::size_t tile_row);

    /// The row of tiles of a level (1 …) that is complete or was started last.
    struct Rows {
        const std::byte* samples = nullptr;  // columns × rows
        const std::uint8_t* valid = nullptr; // 1 or 0 each; null without mask
        std::size_t columns = 0;
        std::size_t rows = 0;
        // What they lie in, if that may be a file.
        const ScratchBytes* samples_in = nullptr;
        const ScratchBytes* valid_in = nullptr;

        /// As ScratchBytes::release().
        void release() const noexcept
        {
            for (const ScratchBytes* bytes : {samples_in, valid_in}) {
                if (bytes != nullptr) {
                    bytes->release();
                }
            }
        }
    };
    /// After the tiles of `tile_row`, for 1 <= level <= kStreamedLevels.
    Rows rowsOf(std::size_t level, std::size_t tile_row) const;
    /// Releases the rows of all levels, as ScratchBytes::release().
    void release() const noexcept;

    /// After all tiles: a level beyond kStreamedLevels, whole. Ascending, each once.
    Rows makeLevel(std::size_t level);

    /// The sums of the raster's tiles of some rows, from which levels beyond kStreamedLevels are
    /// made; empty without such levels. For copying them from one builder to another.
    struct TileSums {
        std::span<std::uint64_t> sums; // bits of integers or doubles
        std::span<std::uint64_t> counts;
    };
    TileSums sumsOf(std::size_t first_tile_row, std::size_t end_tile_row);

    /// The state needed to resume after the first `tile_rows` rows of tiles.
    std::vector<std::uint8_t> save(std::size_t tile_rows) const;
    /// False if `saved` is not from such a builder; the builder then stays usable.
    bool restore(std::size_t tile_rows, const std::vector<std::uint8_t>& saved);

private:
    struct Level {
        std::size_t columns = 0;
        std::size_t rows = 0;
        ScratchBytes samples; // a row of tiles, or the whole level beyond kStreamedLevels
        ScratchBytes valid;
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
    // The blocks of level kStreamedLevels, one per tile of the raster, if coarser levels need them.
    // Sums are integers or doubles, depending on the type.
    LargeVector<std::uint64_t> sum_bits_;
    LargeVector<std::uint64_t> counts_;
    std::size_t made_level_ = kStreamedLevels;
    std::size_t made_columns_ = 0;
    std::size_t made_rows_ = 0;
};

} // namespace marsview
