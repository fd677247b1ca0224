// Tiles straight from a raster file that is stored in tiles and has overviews.
#pragma once

#include "core/raster/raster_file.h"
#include "core/tiles/tile_checksums.h"
#include "core/tiles/tile_source.h"

#include <memory>
#include <string>
#include <vector>

namespace marsview {

/// A raster file that can be read in pieces without reading much more than these: blocks of at most
/// kBlockSideMax a side, with overviews by powers of two.
class GeotiffTileSource final : public TileSource {
public:
    static constexpr std::size_t kBlockSideMax = 1024;
    /// Samples exist at levels up to this: each further one is four times as much to read for the
    /// same tile.
    static constexpr std::size_t kLastLevel = 2;

    /// Looks at `file`, which stays the caller's. Unsupported, with the reason, where it cannot be
    /// read in pieces. `nodata` counts in place of the file's.
    static Result<std::shared_ptr<const GeotiffTileSource>> of(const RasterFile& file,
                                                               const VoidRule& voids);

    /// The same raster, whose tiles are errors where they are not those that `checksums` were taken
    /// of. `remedy` ends the sentences that say so.
    std::shared_ptr<const GeotiffTileSource>
    checkedBy(std::shared_ptr<const TileChecksums> checksums,
              const std::string& remedy = "prepare the map again") const;

    /// Samples at levels 0 … kLastLevel, Means at 1 … mean_levels. Voids without a fill.
    const TileLayout& layout() const noexcept override { return raster_.layout; }
    const std::string& name() const noexcept override { return raster_.name; }
    Result<std::unique_ptr<TileReader>> open() const override;

private:
    // What its readers need to know.
    struct Raster {
        TileLayout layout;
        std::string path;
        std::string name;           // as the user knows it
        std::string remote_version; // RasterInfo's; all readers read the same
        int band = 1;
        VoidRule voids;
        std::vector<std::size_t> overviews; // of the file, by level; [0] means nothing
        std::shared_ptr<const TileChecksums> checksums = nullptr; // null: nobody knows
        std::string remedy{};                                     // with checksums
    };
    class Reader;

    explicit GeotiffTileSource(Raster raster);

    Raster raster_;
};

} // namespace marsview
