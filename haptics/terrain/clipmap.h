// The part of a map larger than memory that can be touched without waiting.
#pragma once

#include "core/geo/frames.h"
#include "core/levels/tile_heights.h"
#include "core/tiles/tile.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace marsview {

/// The number of tiles per side of a window.
struct WindowSides {
    std::size_t finest = 8;  // at level 0; 3 to Clipmap::kSideMax
    std::size_t coarser = 4; // at every other level; likewise
    bool wraps = false;      // around the body: after the last column comes the first
};

/// The resident tiles of a level, within a square of at most 8 x 8, which may continue with the
/// first column after the last one. A small value.
struct ShownTiles {
    std::uint32_t first_column = 0; // in tiles
    std::uint32_t first_row = 0;
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    std::uint64_t is_there = 0; // one bit per tile, row by row, starting at the lowest bit

    /// Of a level of `tile_columns`.
    bool has(std::uint32_t tile_column,
             std::uint32_t tile_row,
             std::uint32_t tile_columns) const noexcept
    {
        const std::uint32_t c = columnWithin(tile_column, first_column, columns, tile_columns);
        const std::uint32_t r = tile_row - first_row; // wraps if less
        return c < columns && r < rows && ((is_there >> (r * columns + c)) & 1U) != 0;
    }
    /// The position of a tile's column in a square; `columns` or more outside it.
    static std::uint32_t columnWithin(std::uint32_t tile_column,
                                      std::uint32_t first_column,
                                      std::uint32_t columns,
                                      std::uint32_t tile_columns) noexcept
    {
        const std::uint32_t c = tile_column - first_column; // wraps if less
        return c < columns ? c : c + tile_columns;
    }
    bool operator==(const ShownTiles&) const = default;
};

/// For every level of a map, the resident tiles in a square around a position. The coarsest level,
/// which is one tile, is always resident, so that every sample has a height.
///
/// If the level 0 tile of a sample is resident, its height equals that of FilledHeightfield, to the
/// bit. Otherwise it is the height on the triangles of the finest level whose surrounding samples
/// are resident, limited to the maxima of the smallest nodes that contain the sample: a cast that
/// may skip a part of the true surface may also skip it here.
///
/// Filled by one thread, immutable afterwards. Const members: any thread, including the servo
/// thread.
class Clipmap {
public:
    static constexpr std::size_t kSideMax = 8;

    struct Slot {
        std::shared_ptr<const Tile> tile; // null if missing
        /// An upper bound, in meters, of the difference between this tile's surface and that of the
        /// coarser tiles that were in the window when it arrived. Infinite: unknown.
        double difference_m = 0.0;
    };
    /// The tiles of a level, row by row.
    struct Level {
        std::uint32_t first_column = 0; // in tiles
        std::uint32_t first_row = 0;
        std::uint32_t columns = 0;
        std::uint32_t rows = 0;
        std::uint32_t tile_columns = 0; // of the whole level
        std::vector<Slot> slots;

        /// The column of a tile in a slot.
        std::uint32_t tileColumn(std::size_t i) const noexcept
        {
            const std::uint32_t column = first_column + static_cast<std::uint32_t>(i % columns);
            return column < tile_columns ? column : column - tile_columns;
        }
        std::uint32_t tileRow(std::size_t i) const noexcept
        {
            return first_row + static_cast<std::uint32_t>(i / columns);
        }
    };
    /// The tiles that determine the height of a sample at a level, each once.
    struct Sources {
        std::array<TileId, 3> tiles;
        std::size_t count = 0;
    };
    struct Reading {
        double height_m;
        std::size_t level;
    };

    /// Along an axis with `tiles` tiles at a level, the first of the `side` (<= tiles) tiles around
    /// a center, which is given in samples of the map.
    static std::size_t
    firstTile(double center, std::size_t level, std::size_t tiles, std::size_t side) noexcept;
    /// The same where the axis goes around: not within the tiles, but on the center's turn.
    static std::int64_t
    firstTileAround(double center, std::size_t level, std::size_t side) noexcept;

    /// Whether such a square is valid at a level of a map.
    static bool
    fits(const TileLayout& layout, std::size_t level, const ShownTiles& square) noexcept;

    /// `top` is the tile of the coarsest level. Level k is centered on `centers[k]`, in samples of
    /// the map; there is one entry per level.
    Clipmap(std::shared_ptr<const TileHeights> heights,
            std::shared_ptr<const Tile> top,
            const std::vector<GridPoint>& centers,
            const WindowSides& sides = {});

    /// With the squares of another window, one per level, each within the map's tiles. Only `top`
    /// is resident until other tiles are put.
    Clipmap(std::shared_ptr<const TileHeights> heights,
            std::shared_ptr<const Tile> top,
            std::span<const ShownTiles> squares);

    /// Requires a tile within the window whose samples can all be touched
    /// (TileHeights::isTouchable).
    void put(std::shared_ptr<const Tile> tile, double difference_m);

    const TileHeights& heights() const noexcept { return *heights_; }
    std::size_t levelCount() const noexcept { return levels_.size(); }
    const Level& level(std::size_t level) const noexcept { return levels_[level]; }
    ShownTiles shown(std::size_t level) const noexcept;
    /// Null if the window does not cover the tile.
    const Slot* slot(const TileId& id) const noexcept { return slot(id.level, id.column, id.row); }
    bool has(const TileId& id) const noexcept
    {
        const Slot* found = slot(id);
        return found != nullptr && found->tile != nullptr;
    }

    /// In meters. Unchecked precondition: inside the map.
    Reading read(std::size_t column, std::size_t row) const noexcept;
    double height(std::size_t column, std::size_t row) const noexcept
    {
        return read(column, row).height_m;
    }
    /// The height that one level gives for a sample of the map, whether or not a finer one is
    /// resident. Empty if a tile is missing. Not limited by maxima.
    std::optional<double> heightAtLevel(std::size_t level,
                                        std::size_t column,
                                        std::size_t row,
                                        Sources* sources = nullptr) const noexcept;
    /// Whether the nearest sample, up and to the left, of the finest resident level is void.
    bool isVoid(std::size_t column, std::size_t row) const noexcept;

    /// For Slot::difference_m of a tile that was put. Takes a millisecond or more: not for the
    /// servo thread.
    double differenceFromCoarser(const TileId& id) const;

private:
    void putTop(std::shared_ptr<const Tile> top);
    const Slot* slot(std::size_t level, std::size_t column, std::size_t row) const noexcept
    {
        const Level& l = levels_[level];
        std::size_t c = column - l.first_column; // wraps if less
        if (c >= l.columns) [[unlikely]] {
            c += l.tile_columns;
        }
        const std::size_t r = row - l.first_row;
        return c < l.columns && r < l.rows ? &l.slots[r * l.columns + c] : nullptr;
    }
    std::optional<double>
    vertex(std::size_t level, std::size_t column, std::size_t row) const noexcept;

    std::shared_ptr<const TileHeights> heights_;
    std::vector<Level> levels_;
};

} // namespace marsview
