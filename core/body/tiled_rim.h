// The heights along the border of a map in tiles.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/body/body_positions.h"
#include "core/levels/tile_heights.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace marsview {

class WaitingTerrain;

/// The samples of the two outermost rows and columns at full resolution. A BodyMesh over a terrain
/// with these has a border that does not depend on the tiles in memory, and so do all triangles
/// with a vertex on it: they can be joined with other maps. Immutable; any thread. 32 bytes per row
/// and column.
class TiledRim {
public:
    /// Whether the border of a map can be read: without voids, and with bounds that are measured.
    static bool canRead(const TileHeights& heights) noexcept
    {
        return heights.filledMaxima().empty();
    }
    /// Reads the tiles along the border of such a map. Errors: those of reading a tile; Canceled.
    /// Not for the servo thread.
    static Result<std::shared_ptr<const TiledRim>>
    read(const BodyPositions& positions, const WaitingTerrain& terrain, JobMonitor& monitor);

    /// In meters, of a sample of the positions; null if it is further inside.
    const double* find(std::size_t column, std::size_t row) const noexcept
    {
        if (row < kWidth) {
            return &rows_m_[row * columns_ + column];
        }
        if (row + kWidth >= rows_) {
            return &rows_m_[(row + 2 * kWidth - rows_) * columns_ + column];
        }
        if (columns_m_.empty()) {
            return nullptr;
        }
        if (column < kWidth) {
            return &columns_m_[column * rows_ + row];
        }
        return column + kWidth >= columns_
                   ? &columns_m_[(column + 2 * kWidth - columns_) * rows_ + row]
                   : nullptr;
    }

private:
    static constexpr std::size_t kWidth = 2; // samples, at each side

    TiledRim() = default;

    std::size_t columns_ = 0; // of the positions
    std::size_t rows_ = 0;
    std::vector<double> rows_m_;    // the first ones, then the last ones
    std::vector<double> columns_m_; // likewise; empty for a map around the body
};

} // namespace marsview
