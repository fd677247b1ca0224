// The file format of one tile.
#pragma once

#include "core/tiles/tile.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace marsview {

/// An upper bound on the size of a tile's file.
inline constexpr std::size_t kTileFileBytesMax = std::size_t{4} << 20;

/// The tile with the key of its source, compressed, with a checksum of everything. Empty if memory
/// allocation fails. Any thread.
std::vector<std::byte> encodeTileFile(const Tile& tile, const std::string& key);

enum class TileFileState {
    Good,
    Damaged,
    OfAnother, // intact, but of another source or position
};

struct DecodedTileFile {
    TileFileState state = TileFileState::Damaged;
    std::optional<Tile> tile; // present if Good
};

/// Safe for arbitrary bytes.
DecodedTileFile decodeTileFile(std::span<const std::byte> file,
                               const TileId& id,
                               const TileLayout& layout,
                               const std::string& key);

} // namespace marsview
