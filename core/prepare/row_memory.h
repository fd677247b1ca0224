// The memory for whole rows of tiles.
#pragma once

#include "core/base/scratch_bytes.h"
#include "core/raster/sample_type.h"
#include "core/tiles/tile.h"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace marsview {

/// Rows of tiles are as wide as the map. Those that are too large for memory lie in scratch files,
/// and work on them goes from one column of tiles to the next, in steps.
struct RowMemory {
    std::optional<ScratchPlace> scratch{}; // none: everything is in memory
    /// Of samples of two bytes; fewer of larger ones.
    std::size_t columns_at_once = 128 * kTileSide;

    const ScratchPlace* place() const noexcept { return scratch ? &*scratch : nullptr; }
    std::size_t tilesAtOnce(SampleType type) const noexcept
    {
        return std::max<std::size_t>(1, 2 * columns_at_once / kTileSide / sampleBytes(type));
    }
};

} // namespace marsview
