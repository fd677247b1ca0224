// One tile as a file.
#pragma once

#include "core/tiles/tile.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace marsview {

/// Larger than any tile's file.
inline constexpr std::size_t kTileFileBytesMax = std::size_t{4} << 20;

/// The tile with the key of its source, compressed, with a checksum over all of it. Empty where
/// there is no memory. Any thread.
std::vector<std::byte> encodeTileFile(const Tile& tile, const std::string& key);

enum class TileFileState {
    Good,
    Damaged,
    OfAnother, // whole, but of another source or place
};

struct DecodedTileFile {
    TileFileState state = TileFileState::Damaged;
    std::optional<Tile> tile; // there where Good
};

/// Believes nothing: any bytes may be given.
DecodedTileFile decodeTileFile(std::span<const std::byte> file,
                               const TileId& id,
                               const TileLayout& layout,
                               const std::string& key);

} // namespace marsview
