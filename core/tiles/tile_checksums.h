// Checksums, computed when tiles are first read, that detect damaged tiles of a raster.
#pragma once

#include "core/base/scratch_bytes.h"
#include "core/raster/grid_window.h"
#include "core/raster/sample_grid.h"
#include "core/tiles/tile.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace marsview {

/// A checksum for every tile that is stored in a raster: Samples at level 0, and Means. Any threads
/// may write, each tile once; immutable afterwards.
///
/// GDAL may silently decode wrong samples from a compressed tile with a few wrong bytes.
class TileChecksums {
public:
    /// All checksums are 0.
    explicit TileChecksums(const TileLayout& layout);

    /// The number of tiles of a raster that have a checksum.
    static std::size_t countFor(const TileLayout& layout);
    /// Whether this tile has a checksum.
    static bool covers(const TileId& id) noexcept
    {
        return id.kind == TileKind::Means || id.level == 0;
    }

    std::uint32_t of(const TileId& id) const { return values()[numberOf(id)]; }
    void set(const TileId& id, std::uint32_t checksum) { values()[numberOf(id)] = checksum; }

    /// Samples row by row, then the means of each level.
    std::span<const std::uint32_t> values() const noexcept
    {
        return {reinterpret_cast<const std::uint32_t*>(values_.data()), count_};
    }
    std::span<std::uint32_t> values() noexcept
    {
        return {reinterpret_cast<std::uint32_t*>(values_.data()), count_};
    }

private:
    std::size_t numberOf(const TileId& id) const;

    struct Level {
        std::size_t first = 0;
        std::size_t tile_columns = 0;
    };
    std::vector<Level> levels_; // samples, then means from level 1 on
    std::size_t count_;
    ScratchBytes values_; // those of rows of tiles that are not used take no memory
};

/// CRC-32 of the raw samples.
std::uint32_t sampleChecksum(const SampleGrid& samples);

/// The same for a part of the samples, as if it were a separate grid.
std::uint32_t sampleChecksum(const SampleGrid& samples, const GridWindow& part);

} // namespace marsview
