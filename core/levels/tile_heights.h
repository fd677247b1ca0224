// Heights from the samples of tiles, with voids filled: those of FilledHeightfield to the bit.
#pragma once

#include "core/levels/level_file.h"
#include "core/raster/raster_info.h"
#include "core/terrain/heightfield.h"
#include "core/tiles/tile.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace marsview {

/// The data of a whole tiled map. Immutable; any thread, including the servo thread.
class TileHeights {
public:
    /// The heights of the analysis in `levels` use `scale`.
    TileHeights(std::shared_ptr<const MapLevels> levels, const ElevationScale& scale);

    const TileLayout& layout() const noexcept { return levels_->layout; }
    const ElevationScale& scale() const noexcept { return scale_; }
    const HeightRange& range() const noexcept { return range_; }

    /// Whether all void samples have a fill height.
    static bool isTouchable(const Tile& tile) noexcept
    {
        return !tile.samples.hasVoids() ||
               tile.filled_m.size() == tile.samples.columns() * tile.samples.rows();
    }
    /// In meters. The tile must be touchable (isTouchable); indices are relative to the tile.
    double sample(const Tile& tile, std::size_t column, std::size_t row) const noexcept;

    /// The nodes of the hierarchy are those of MinMaxPyramid.
    std::size_t levelCount() const noexcept { return levels_->analysis->bounds.levelCount(); }
    /// Upper bound of the node's filled samples, in meters.
    double maximum(std::size_t level, std::size_t column, std::size_t row) const noexcept
    {
        const MinMaxPyramid& bounds = levels_->analysis->bounds;
        return static_cast<double>(
            levels_->filled_maxima_m.empty()
                ? bounds.bounds(level, column, row).maximum_m
                : levels_->filled_maxima_m[level][row * bounds.columns(level) + column]);
    }
    const MinMaxPyramid& bounds() const noexcept { return levels_->analysis->bounds; }
    /// As in MapLevels.
    const std::vector<std::vector<float>>& filledMaxima() const noexcept
    {
        return levels_->filled_maxima_m;
    }
    /// The smallest maximum of the smallest nodes that contain a sample of the map. A substitute
    /// for its height must not be higher, or a cast could pass through it.
    double ceiling(std::size_t column, std::size_t row) const noexcept;

private:
    std::shared_ptr<const MapLevels> levels_;
    ElevationScale scale_;
    HeightRange range_;
};

} // namespace marsview
