// Tiles directly from a tiled raster file with overviews.
#pragma once

#include "core/raster/raster_file.h"
#include "core/tiles/tile_checksums.h"
#include "core/tiles/tile_source.h"

#include <memory>
#include <string>
#include <vector>

namespace marsview {

/// A raster file in which a tile can be read without reading much more: blocks of at most
/// kBlockSideMax a side, with overviews by powers of two.
class GeotiffTileSource final : public TileSource {
public:
    static constexpr std::size_t kBlockSideMax = 1024;
    /// Samples exist at levels up to this: each further level reads four times as much per tile.
    static constexpr std::size_t kLastLevel = 2;

    /// Inspects `file`, which the caller keeps; its open files stay open for the readers.
    /// Unsupported, with the reason, if it cannot be read in tiles. `nodata` replaces the file's.
    static Result<std::shared_ptr<const GeotiffTileSource>> of(const RasterFile& file,
                                                               const VoidRule& voids);

    /// The same raster; tiles that do not match `checksums` are errors. `remedy` ends their
    /// messages.
    std::shared_ptr<const GeotiffTileSource>
    checkedBy(std::shared_ptr<const TileChecksums> checksums,
              const std::string& remedy = "prepare the map again") const;

    /// Samples at levels 0 … kLastLevel, Means at 1 … mean_levels. Voids without a fill.
    const TileLayout& layout() const noexcept override { return raster_.layout; }
    const std::string& name() const noexcept override { return raster_.name; }
    Result<std::unique_ptr<TileReader>> open() const override;

private:
    // Shared data of its readers.
    struct Raster {
        TileLayout layout;
        std::string path;
        std::string name;           // for messages
        std::string remote_version; // from RasterInfo; all readers read this version
        int band = 1;
        VoidRule voids;
        std::vector<std::size_t> overviews; // of the file, by level; [0] is unused
        OpenFiles open_files;               // for all readers
        std::shared_ptr<const TileChecksums> checksums = nullptr; // null: unknown
        std::string remedy{};                                     // for checksum errors
    };
    class Reader;

    explicit GeotiffTileSource(Raster raster);

    Raster raster_;
};

} // namespace marsview
