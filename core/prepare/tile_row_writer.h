// Encodes rows of tiles of a map and of its overviews, and appends them to a laid-out file.
#pragma once

#include "core/base/result.h"
#include "core/prepare/overview_builder.h"
#include "core/prepare/row_memory.h"
#include "core/prepare/tiff/encoded_tiles.h"
#include "core/raster/raster_info.h"
#include "core/raster/sample_grid.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace marsview {

/// Tiles of a row are encoded on all cores, a limited
/// number at a time. For one thread.
class TileRowWriter {
public:
    /// Opens a file of writeGeoTiffSkeleton(), as TiffTiles. Unreadable if it was not laid out for
    /// such a map.
    static Result<TileRowWriter>
    open(const std::string& path, const RasterInfo& info, const RowMemory& memory = {});

    /// To a file whose pages are those of the map.
    static Result<TileRowWriter> to(std::unique_ptr<EncodedTiles> tiles,
                                    const RasterInfo& info,
                                    const std::string& path,
                                    const RowMemory& memory);

    EncodedTiles& tiles() noexcept { return *tiles_; }
    const EncodedTiles& tiles() const noexcept { return *tiles_; }
    std::size_t levelCount() const noexcept { return pages_.size(); }
    /// The page of a level, 0 being the raster, and of its mask if the map needs one.
    std::size_t page(std::size_t level) const { return pages_[level]; }
    bool hasMasks() const noexcept { return !mask_pages_.empty(); }
    std::size_t maskPage(std::size_t level) const { return mask_pages_[level]; }

    /// Appends the raster's row of tiles, whose first row is row `grid_row` of `grid`, then the
    /// row's masks, and adds the tiles to `overviews`.
    Status copyRow(const SampleGrid& grid,
                   std::size_t grid_row,
                   std::size_t tile_row,
                   OverviewBuilder& overviews);
    /// Appends a row of tiles of an overview, then the row's masks.
    Status
    writeLevelRow(std::size_t level, const OverviewBuilder::Rows& rows, std::size_t tile_row);
    /// The same for all rows of a level.
    Status writeLevel(std::size_t level, const OverviewBuilder::Rows& all);

private:
    TileRowWriter(std::unique_ptr<EncodedTiles> tiles,
                  const RasterInfo& info,
                  std::string path,
                  const RowMemory& memory);
    bool findPages();
    template <typename Encode, typename Release>
    Status appendRow(std::size_t page, std::size_t tile_row, Encode&& encode, Release&& release);

    std::unique_ptr<EncodedTiles> tiles_;
    std::string path_;
    std::size_t columns_;
    std::size_t rows_;
    SampleType type_;
    std::size_t tiles_at_once_;
    // Pages by level: 0 is the raster.
    std::vector<std::size_t> pages_;
    std::vector<std::size_t> mask_pages_;
};

} // namespace marsview
