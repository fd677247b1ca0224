// The division of a map into parts: bands of whole rows of level-0 tiles.
#pragma once

#include "core/prepare/ordered_tiles.h"
#include "core/tiles/tile.h"

#include <algorithm>
#include <cstddef>

namespace marsview {

/// Rows of level-0 tiles [first, end); none if there are more parts than rows.
struct PartRows {
    std::size_t first = 0;
    std::size_t end = 0;

    bool has(std::size_t tile_row) const noexcept { return tile_row >= first && tile_row < end; }
    bool isEmpty() const noexcept { return first >= end; }

    /// Whether all samples under row `row` of tiles of a level of Means are in these rows, of
    /// `tile_rows` in the map.
    bool hasMeans(std::size_t level, std::size_t row, std::size_t tile_rows) const noexcept
    {
        return (row << level) >= first && std::min((row + 1) << level, tile_rows) <= end;
    }
    /// The same for a level of Samples.
    bool hasSamples(const TileLayout& layout, std::size_t level, std::size_t row) const
    {
        return firstTileRowOf(layout, level, row) >= first &&
               lastTileRowOf(layout, level, row) < end;
    }
};

/// The rows of part `part`, counted from 1, of `parts`: their numbers differ by one at most.
constexpr PartRows rowsOfPart(std::size_t tile_rows, std::size_t part, std::size_t parts) noexcept
{
    return {tile_rows * (part - 1) / parts, tile_rows * part / parts};
}

} // namespace marsview
