// What shading needs of a piece of a map: slopes, averaged to the size at which they are seen.
#pragma once

#include "core/geo/scene_frame.h"
#include "core/terrain/heightfield.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace marsview {

/// A piece of the map at one level: texel (i, j) of level n stands for the samples
/// [i · 2^n, (i + 1) · 2^n) × likewise, whatever piece it is in.
struct ReliefTileId {
    std::size_t level = 0;
    std::size_t column = 0; // counted in tiles of kTexels texels
    std::size_t row = 0;
    bool operator==(const ReliefTileId&) const = default;
};

/// Mean slopes of the surface per texel, with those of half, a quarter and an eighth of the texels
/// behind them. A mean of slopes over a texel is the slope of its mean height, so shading by them
/// looks the same whichever level it is taken from.
///
/// Slopes are metres up per metre east and per metre north, times the share of the texel's samples
/// that are not void, as signed 16-bit numbers: ±32767 is ±slope_max. Shares are 0 … 255.
struct ReliefTile {
    static constexpr std::size_t kTexels = 256;
    /// Texels around the tile, which filters reach into: whole ones at every level.
    static constexpr std::size_t kBorder = 8;
    static constexpr std::size_t kSide = kTexels + 2 * kBorder;
    static constexpr std::size_t kLevels = 4;

    struct Level {
        std::size_t side = 0;             // texels
        std::vector<std::int16_t> slopes; // east and north, side × side pairs, row by row
        std::vector<std::uint8_t> shares; // side × side; empty where the map has no voids
    };
    std::array<Level, kLevels> levels;
};

/// Makes a tile from samples in memory, reading each of them once. Any thread. `slope_max` > 0:
/// slopes beyond are cut off.
ReliefTile makeReliefTile(const Heightfield& heightfield,
                          const SceneFrame& frame,
                          const ReliefTileId& id,
                          double slope_max);

/// As above on any map. From tiles it is made of means, a quarter of a texel wide, where there are
/// any, so that a tile costs the same at every level; half a texel where they come from a server,
/// for a quarter of the bytes. On noisy fractals slopes are off by 10 % of their root mean square
/// then, and by 20 %. Waits for those tiles, and passes on why one could not be read.
Result<ReliefTile> loadReliefTile(const Heightfield& heightfield,
                                  const SceneFrame& frame,
                                  const ReliefTileId& id,
                                  double slope_max);

} // namespace marsview
