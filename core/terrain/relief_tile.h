// The data for coloring and shading a part of a map: slopes and elevations, averaged to the
// displayed size.
#pragma once

#include "core/geo/scene_frame.h"
#include "core/terrain/heightfield.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace marsview {

/// A part of the map at one level: texel (i, j) of level n represents the samples [i · 2^n, (i + 1)
/// · 2^n) × likewise, in every tile.
struct ReliefTileId {
    std::size_t level = 0;
    std::size_t column = 0; // counted in tiles of kTexels texels
    std::size_t row = 0;
    bool operator==(const ReliefTileId&) const = default;
};

/// One texel: means over its samples, as signed 16-bit numbers, each multiplied by the fraction of
/// valid samples. Filters may mix them; a mixed value divided by the mixed share is the mean.
struct ReliefTexel {
    std::int16_t east = 0;   // slope: ±32767 is ±slope_max meters up per meter east
    std::int16_t north = 0;  // likewise per meter north
    std::int16_t height = 0; // ±32767 is ±height_reach_m from height_middle_m
    std::int16_t share = 0;  // 0 … 32767: fraction of valid samples
    bool operator==(const ReliefTexel&) const = default;
};

/// Mean slopes and elevations of the surface per texel, followed by those with half, a quarter and
/// an eighth of the texels per side. The mean slope over a texel is the slope of its mean
/// elevation, so pictures look the same from every level.
///
/// Elevations are scaled to 16 bits per tile: their error is at most 1/131 000 of the tile's
/// relief, 0.2 m if it spans all of Mars. Finer tiles span less.
struct ReliefTile {
    static constexpr std::size_t kTexels = 256;
    /// Texels around the tile for filters: whole texels at every level.
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

/// Whether the terrain ends at a map's first and last column, or continues at the other side.
enum class MapSides : std::uint8_t { End, Meet };

/// Makes a tile from samples in memory, reading each of them once. Any thread. `slope_max` > 0:
/// larger slopes are clamped.
ReliefTile makeReliefTile(const Heightfield& heightfield,
                          const SceneFrame& frame,
                          const ReliefTileId& id,
                          double slope_max,
                          MapSides sides = MapSides::End);

/// As above for any map. On a tiled map it uses means, if there are any, so that a tile costs the
/// same at every level: a quarter of a texel wide, or half a texel from a server, for a quarter of
/// the bytes. On noisy fractals the slope error is then 10 % or 20 % of their root mean square.
/// Waits for those tiles and returns their read errors.
Result<ReliefTile> loadReliefTile(const Heightfield& heightfield,
                                  const SceneFrame& frame,
                                  const ReliefTileId& id,
                                  double slope_max,
                                  MapSides sides = MapSides::End);

} // namespace marsview
