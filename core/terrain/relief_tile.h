// What coloring and shading need of a piece of a map: slopes and elevations, averaged to the size
// at which they are seen.
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

/// One texel: means over its samples, as signed 16-bit numbers, each times the share of the samples
/// that are not void. Filters may mix them; what is mixed, divided by the mixed share, is the mean.
struct ReliefTexel {
    std::int16_t east = 0;   // slope: ±32767 is ±slope_max metres up per metre east
    std::int16_t north = 0;  // likewise per metre north
    std::int16_t height = 0; // ±32767 is ±height_reach_m from height_middle_m
    std::int16_t share = 0;  // 0 … 32767: of the texel's samples, those that are not void
    bool operator==(const ReliefTexel&) const = default;
};

/// Mean slopes and elevations of the surface per texel, with those of half, a quarter and an eighth
/// of the texels behind them. A mean of slopes over a texel is the slope of its mean elevation, so
/// pictures look the same whichever level they are taken from.
///
/// Elevations are spread over the 16 bits of each tile: they are within 1/131 000 of the tile's
/// relief, 0.2 m where it spans all of Mars. A finer tile spans less.
struct ReliefTile {
    static constexpr std::size_t kTexels = 256;
    /// Texels around the tile, which filters reach into: whole ones at every level.
    static constexpr std::size_t kBorder = 8;
    static constexpr std::size_t kSide = kTexels + 2 * kBorder;
    static constexpr std::size_t kLevels = 4;

    struct Level {
        std::size_t side = 0;            // texels
        std::vector<ReliefTexel> texels; // side × side, row by row
    };
    std::array<Level, kLevels> levels;
    double height_middle_m = 0.0;
    double height_reach_m = 1.0; // > 0
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
