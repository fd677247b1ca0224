// The file next to a tiled raster with its multi-resolution data: the nested levels of its samples
// and the analysis of the whole map.
//
// The raster itself is a tiled GeoTIFF with overviews (means), which other programs read. Levels 1
// and 2 are cheap to read from its samples; levels from kFirstLevel on are stored here, a fiftieth
// of the raster.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/raster/raster_info.h"
#include "core/sources/source_identity.h"
#include "core/terrain/surface_analysis.h"
#include "core/tiles/tile.h"
#include "core/tiles/tile_cache.h"
#include "core/tiles/tile_checksums.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace marsview {

/// The source of a level file. A level file with a different key is not used.
struct LevelFileKey {
    SourceIdentity raster; // the tiled raster
    int band = 1;
    std::optional<double> nodata; // raw
    bool operator==(const LevelFileKey&) const = default;
};

/// The data of the whole map that is available once the file is open.
struct MapLevels {
    TileLayout layout;
    SampleStatistics statistics;
    std::shared_ptr<const SurfaceAnalysis> analysis; // heights in meters at the requested scale
    /// Upper bounds of the filled samples of each node, in meters, one array per level as in the
    /// analysis' bounds. Empty if those bounds suffice: if they are measured and no sample is void.
    std::vector<std::vector<float>> filled_maxima_m;
    std::shared_ptr<const TileChecksums> checksums; // of the raster; null if there are none
};

/// An open level file. For one thread at a time; open it again for another.
class LevelFile {
public:
    /// The first level of samples stored in the file.
    static constexpr std::size_t kFirstLevel = 3;

    /// The path of a raster's level file, next to the raster.
    static std::string pathFor(const std::string& raster_path);

    /// NotFound if it does not exist. Invalid, with the reason, if it is damaged, truncated, of
    /// another version, or made from another source than `expected`. Accepts GDAL paths
    /// (/vsicurl/…).
    static Result<LevelFile> open(const std::string& path, const LevelFileKey& expected);

    LevelFile(LevelFile&&) noexcept;
    LevelFile& operator=(LevelFile&&) noexcept;
    ~LevelFile();

    /// Reads the analysis; some 1/200 of a byte per sample. The same bits as analyze() on the map
    /// in memory (means: from the stored level up) if `scale` is the scale of the file. Otherwise
    /// bounds still have the same bits, and the rest is converted.
    Result<MapLevels> readLevels(const ElevationScale& scale) const;

    /// Only the checksums of the raster's tiles: reads 4 bytes per tile.
    Result<std::shared_ptr<const TileChecksums>> readChecksums() const;

    /// The samples of a Samples tile at a level >= kFirstLevel. Checked against its checksum.
    Result<SampleGrid> readSamples(const TileId& id) const;

    /// The fill heights of a tile's void samples at level 0 or >= kFirstLevel (Tile::filled_m);
    /// empty without voids. The same bits as FilledHeightfield on the map in memory if `scale` is
    /// the scale of the file.
    Result<std::vector<float>> readFilled(const TileId& id, const ElevationScale& scale) const;

    /// Reads the whole file and verifies its checksums. Errors: Invalid or Unreadable if it is
    /// damaged, Canceled. The levels of samples are a fiftieth of the raster.
    Status check(const JobMonitor& monitor) const;

private:
    struct Impl;
    explicit LevelFile(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

} // namespace marsview
