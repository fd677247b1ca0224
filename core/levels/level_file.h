// The small file beside a tiled raster that makes it a multi-resolution one: the nested levels of
// its samples, and everything that is measured once over a whole map.
//
// The raster itself is a tiled GeoTIFF with overviews (means), which other programs read. Levels 1
// and 2 are cheap to take from its samples; from kFirstLevel on they are kept here, a fiftieth of
// the raster.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/raster/raster_info.h"
#include "core/raster/source_identity.h"
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

/// What a level file is made from. One that was made from something else is not used.
struct LevelFileKey {
    SourceIdentity raster; // the tiled raster that it belongs to
    int band = 1;
    std::optional<double> nodata; // raw
    bool operator==(const LevelFileKey&) const = default;
};

/// What is known of the whole map as soon as the file is open.
struct MapLevels {
    TileLayout layout;
    SampleStatistics statistics;
    std::shared_ptr<const SurfaceAnalysis> analysis; // heights in metres by the scale asked for
    /// No sample of a node is higher, once filled; a level each as in the analysis' bounds, in
    /// metres. Empty where these bounds tell: where they are measured and no sample is void.
    std::vector<std::vector<float>> filled_maxima_m;
    std::shared_ptr<const TileChecksums> checksums; // of the raster; null where nobody took them
};

/// An open level file. For one thread at a time; open it again for another.
class LevelFile {
public:
    /// The coarsest levels of samples are kept from here on.
    static constexpr std::size_t kFirstLevel = 3;

    /// Where the level file of a raster lies: beside it.
    static std::string pathFor(const std::string& raster_path);

    /// NotFound where there is none. Invalid, with the reason, where it is damaged, cut short, of
    /// another version, or made from something else than `expected`. Paths may be GDAL's
    /// (/vsicurl/…).
    static Result<LevelFile> open(const std::string& path, const LevelFileKey& expected);

    LevelFile(LevelFile&&) noexcept;
    LevelFile& operator=(LevelFile&&) noexcept;
    ~LevelFile();

    /// Reads what is measured; some 1/200 of a byte a sample. The same bits as analyse() on the map
    /// held in memory (means: from the level up at which they are kept) where `scale` is the one
    /// the file was made with. Otherwise bounds are of the same bits still, and the rest is
    /// converted.
    Result<MapLevels> readLevels(const ElevationScale& scale) const;

    /// The checksums of the raster's tiles alone: 4 bytes a tile are read.
    Result<std::shared_ptr<const TileChecksums>> readChecksums() const;

    /// The samples of a Samples tile at a level >= kFirstLevel. Checked against its checksum.
    Result<SampleGrid> readSamples(const TileId& id) const;

    /// What the void samples of a tile at level 0, or >= kFirstLevel, are filled with
    /// (Tile::filled_m); empty where none of them is void. Where `scale` is the one the file was
    /// made with, the same bits as FilledHeightfield on the map held in memory.
    Result<std::vector<float>> readFilled(const TileId& id, const ElevationScale& scale) const;

    /// Reads everything that is in the file and holds it against its checksums: Invalid or
    /// Unreadable where it is damaged, Cancelled. Levels of samples are a fiftieth of the raster.
    Status check(const JobMonitor& monitor) const;

private:
    struct Impl;
    explicit LevelFile(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

} // namespace marsview
