// Tiles of a raster that is larger than memory.
#pragma once

#include "core/raster/sample_grid.h"
#include "core/raster/sample_type.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace marsview {

/// Samples along a side of a tile.
inline constexpr std::size_t kTileSide = 256;

/// The kind of a tile's samples. In both kinds tiles do not overlap: sample i of a level is in tile
/// i / kTileSide, so every sample is stored once.
enum class TileKind : std::uint8_t {
    /// Level k holds every 2^k-th sample of every 2^k-th row, and the last column and row: sample i
    /// of a level is sample min(i · 2^k, count - 1) of the raster. Levels are nested: all finer
    /// levels have the samples of a level, to the bit.
    Samples,
    /// Level k >= 1 holds means over blocks of 2^k × 2^k samples, excluding voids. For display
    /// only, never for touching or for values shown to people.
    Means,
};

/// Identifies a tile of a raster.
struct TileId {
    TileKind kind = TileKind::Samples;
    std::uint8_t level = 0;
    std::uint32_t column = 0; // counted in tiles
    std::uint32_t row = 0;
    bool operator==(const TileId&) const = default;
};

struct TileIdHash {
    std::size_t operator()(const TileId& id) const noexcept
    {
        std::uint64_t h = (static_cast<std::uint64_t>(id.kind) << 8 | id.level) + 1;
        h = (h * 0x9E3779B97F4A7C15ULL) ^ id.column;
        h = (h ^ (h >> 29)) * 0xBF58476D1CE4E5B9ULL + id.row;
        h = (h ^ (h >> 32)) * 0x94D049BB133111EBULL;
        return static_cast<std::size_t>(h ^ (h >> 31));
    }
};

/// How a raster of columns × rows samples (at least 2 × 2) is divided into tiles.
struct TileLayout {
    std::size_t columns = 0;
    std::size_t rows = 0;
    SampleType type = SampleType::Int16;
    bool has_voids = false;      // tiles may have voids
    std::size_t mean_levels = 0; // Means exist at levels 1 … mean_levels
    bool is_remote = false;      // every tile costs a request to a server: request few

    /// Samples of a level along an axis with `count` samples.
    static constexpr std::size_t
    samplesAlong(TileKind kind, std::size_t level, std::size_t count) noexcept
    {
        const std::size_t step = std::size_t{1} << level;
        return kind == TileKind::Samples ? (count - 1 + step - 1) / step + 1
                                         : (count + step - 1) / step;
    }
    std::size_t columnsAt(TileKind kind, std::size_t level) const noexcept
    {
        return samplesAlong(kind, level, columns);
    }
    std::size_t rowsAt(TileKind kind, std::size_t level) const noexcept
    {
        return samplesAlong(kind, level, rows);
    }
    std::size_t tileColumns(TileKind kind, std::size_t level) const noexcept
    {
        return (columnsAt(kind, level) + kTileSide - 1) / kTileSide;
    }
    std::size_t tileRows(TileKind kind, std::size_t level) const noexcept
    {
        return (rowsAt(kind, level) + kTileSide - 1) / kTileSide;
    }
    /// The coarsest level of Samples: the first that is a single tile.
    std::size_t topLevel() const noexcept
    {
        std::size_t level = 0;
        while (tileColumns(TileKind::Samples, level) * tileRows(TileKind::Samples, level) > 1) {
            ++level;
        }
        return level;
    }
    /// The width and height of a tile: kTileSide, or less at the last column and row.
    std::size_t tileWidth(const TileId& id) const noexcept
    {
        return std::min(kTileSide, columnsAt(id.kind, id.level) - id.column * kTileSide);
    }
    std::size_t tileHeight(const TileId& id) const noexcept
    {
        return std::min(kTileSide, rowsAt(id.kind, id.level) - id.row * kTileSide);
    }
    bool contains(const TileId& id) const noexcept
    {
        return id.column < tileColumns(id.kind, id.level) && id.row < tileRows(id.kind, id.level) &&
               (id.kind == TileKind::Samples ? id.level <= topLevel()
                                             : id.level >= 1 && id.level <= mean_levels);
    }
};

/// A decoded tile. Immutable after construction; any thread.
struct Tile {
    TileId id;
    SampleGrid samples; // tileWidth × tileHeight, raw; void samples are marked
    /// For Samples with voids: the fill heights of void samples in meters, in the order of the
    /// samples; values at other samples are meaningless. Empty without voids.
    std::vector<float> filled_m;

    std::size_t bytes() const noexcept { return samples.bytes() + filled_m.size() * sizeof(float); }
};

} // namespace marsview
