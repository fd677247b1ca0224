// Tiles of a level file that a part of the map has stored in a file of its own.
#pragma once

#include "core/files/file_bytes.h"
#include "core/levels/level_file.h"
#include "core/levels/level_file_format.h"
#include "core/prepare/ordered_tiles.h"
#include "core/prepare/parts/part_rows.h"

#include <cstddef>
#include <vector>

namespace marsview {

/// Calls `function` with the stored tiles of levels whose last row of level-0 tiles is in the
/// part, and with that row.
template <typename Function>
void forEachKeptTile(const TileLayout& layout, const PartRows& part, Function&& function)
{
    for (std::size_t level = LevelFile::kFirstLevel; level <= layout.topLevel(); ++level) {
        for (std::size_t row = 0; row < layout.tileRows(TileKind::Samples, level); ++row) {
            const std::size_t last = lastTileRowOf(layout, level, row);
            for (std::size_t column = 0;
                 part.has(last) && column < layout.tileColumns(TileKind::Samples, level);
                 ++column) {
                function(TileId{.kind = TileKind::Samples,
                                .level = static_cast<std::uint8_t>(level),
                                .column = static_cast<std::uint32_t>(column),
                                .row = static_cast<std::uint32_t>(row)},
                         last);
            }
        }
    }
}

struct StoredTile {
    OrderedTiles::Place place;
    FilePart from;
    OrderedTiles::Stored stored;
};

/// Stores the tiles of the part's rows again, row by row, and with them the tiles that wait for
/// these rows. With a null `file`, only the latter.
Status storeAgain(std::vector<StoredTile> tiles,
                  const FileBytes* file,
                  const PartRows& part,
                  OrderedTiles& ordered);

} // namespace marsview
