// The part of a map larger than memory that the hand can touch without waiting.
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

/// How many tiles a side a window has.
struct WindowSides {
    std::size_t finest = 8;  // at level 0; 3 to ResidentWindow::kSideMax
    std::size_t coarser = 4; // at every other level; likewise
};

/// Which tiles of a level are there: a square of them, at most 8 x 8. A small value.
struct ShownTiles {
    std::uint32_t first_column = 0; // counted in tiles
    std::uint32_t first_row = 0;
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    std::uint64_t is_there = 0; // a bit a tile, row by row, from the lowest on

    bool has(std::uint32_t tile_column, std::uint32_t tile_row) const noexcept
    {
        const std::uint32_t c = tile_column - first_column; // wraps where it is less
        const std::uint32_t r = tile_row - first_row;
        return c < columns && r < rows && ((is_there >> (r * columns + c)) & 1U) != 0;
    }
    bool operator==(const ShownTiles&) const = default;
};

/// For every level of a map, a square of tiles around a place: those that are there. The coarsest
/// level, which is one tile, always is, so that there is a height everywhere.
///
/// Where the tile of a sample is there at level 0, its height is that of FilledHeightfield, to the
/// bit. Elsewhere it is that of the finest level whose samples around are there, on the triangles
/// of that level, but never more than the maxima of the smallest nodes that the sample lies on:
/// what may be skipped over the true surface may be skipped over this one.
///
/// Filled by one thread; immutable from then on: any thread, the servo's too, for what is const.
class ResidentWindow {
public:
    static constexpr std::size_t kSideMax = 8;

    struct Slot {
        std::shared_ptr<const Tile> tile; // null where it is missing
        /// No sample that this tile has a say in differs by more from what coarser tiles of the
        /// window, those that were there when it came, make of it; in metres. Infinite: not known.
        double difference_m = 0.0;
    };
    /// The tiles of a level, row by row.
    struct Level {
        std::uint32_t first_column = 0; // counted in tiles
        std::uint32_t first_row = 0;
        std::uint32_t columns = 0;
        std::uint32_t rows = 0;
        std::vector<Slot> slots;
    };
    /// The tiles that have a say in the height of a sample at a level, each once.
    struct Sources {
        std::array<TileId, 3> tiles;
        std::size_t count = 0;
    };
    struct Reading {
        double height_m;
        std::size_t level;
    };

    /// Along an axis with `tiles` tiles at a level, the first of the `side` (<= tiles) around a
    /// centre, which is in samples of the map.
    static std::size_t
    firstTile(double centre, std::size_t level, std::size_t tiles, std::size_t side) noexcept;

    /// Whether there can be such a square at a level of a map.
    static bool
    fits(const TileLayout& layout, std::size_t level, const ShownTiles& square) noexcept;

    /// `top` is the tile of the coarsest level. Level k lies around `centres[k]`, in samples of
    /// the map; there are as many as levels.
    ResidentWindow(std::shared_ptr<const TileHeights> heights,
                   std::shared_ptr<const Tile> top,
                   const std::vector<GridPoint>& centres,
                   const WindowSides& sides = {});

    /// Around the squares that another window had, one a level, each within the map's tiles; of
    /// their tiles there is but `top` until they are put.
    ResidentWindow(std::shared_ptr<const TileHeights> heights,
                   std::shared_ptr<const Tile> top,
                   std::span<const ShownTiles> squares);

    /// The window covers the tile, and its samples can all be touched (TileHeights::isTouchable).
    void put(std::shared_ptr<const Tile> tile, double difference_m);

    const TileHeights& heights() const noexcept { return *heights_; }
    std::size_t levelCount() const noexcept { return levels_.size(); }
    const Level& level(std::size_t level) const noexcept { return levels_[level]; }
    ShownTiles shown(std::size_t level) const noexcept;
    /// Null where the window does not cover the tile.
    const Slot* slot(const TileId& id) const noexcept { return slot(id.level, id.column, id.row); }
    bool has(const TileId& id) const noexcept
    {
        const Slot* found = slot(id);
        return found != nullptr && found->tile != nullptr;
    }

    /// In metres. Unchecked: inside the map.
    Reading read(std::size_t column, std::size_t row) const noexcept;
    double height(std::size_t column, std::size_t row) const noexcept
    {
        return read(column, row).height_m;
    }
    /// What one level makes of a sample of the map, whether or not a finer one is there. Nothing
    /// where a tile is missing. Not bounded by maxima.
    std::optional<double> heightAtLevel(std::size_t level,
                                        std::size_t column,
                                        std::size_t row,
                                        Sources* sources = nullptr) const noexcept;
    /// Whether nothing was measured at the nearest sample, up and to the left, of the finest level
    /// that is there.
    bool isVoid(std::size_t column, std::size_t row) const noexcept;

    /// For Slot::difference_m of a tile that was put. Takes a millisecond or more: not for the
    /// servo thread.
    double differenceFromCoarser(const TileId& id) const;

private:
    void putTop(std::shared_ptr<const Tile> top);
    const Slot* slot(std::size_t level, std::size_t column, std::size_t row) const noexcept
    {
        const Level& l = levels_[level];
        const std::size_t c = column - l.first_column; // wraps where it is less
        const std::size_t r = row - l.first_row;
        return c < l.columns && r < l.rows ? &l.slots[r * l.columns + c] : nullptr;
    }
    std::optional<double>
    vertex(std::size_t level, std::size_t column, std::size_t row) const noexcept;

    std::shared_ptr<const TileHeights> heights_;
    std::vector<Level> levels_;
};

} // namespace marsview
