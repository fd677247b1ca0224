// Opens a raster as a map: files opened here are passed on, never opened again.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/files/shared_file.h"
#include "core/levels/level_file_use.h"
#include "core/prepare/kept_source.h"
#include "core/raster/open_raster.h"
#include "core/session/map.h"
#include "core/session/map_resources.h"
#include "core/tiles/geotiff_tile_source.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace marsview {

/// Where the samples of a map will be.
enum class MapStorage {
    InMemory,
    Tiled,          // read as they are needed
    NeedsOverviews, // too large for memory; tiled once its overviews are built, which takes minutes
};

/// An open raster, and how it can become a map. For one thread at a time.
class MapOpening {
public:
    /// Decides by the file and by existing prepared files. Reads a few dozen kilobytes. Refuses
    /// rasters that are not a surface, and remote ones that can neither be read in pieces nor
    /// fetched whole. Damaged if the raster was damaged since its level file was built.
    static Result<MapOpening> begin(OpenRaster raster, const MapResources& resources);

    const OpenRaster& raster() const noexcept { return raster_; }
    /// For the user, such as why a level file is not used.
    const std::vector<std::string>& notices() const noexcept { return notices_; }
    MapStorage storage() const noexcept { return storage_; }
    /// The level file of a tiled map, if it has one.
    std::optional<std::string> levelPath() const
    {
        return levels_ ? std::optional(levels_->path) : std::nullopt;
    }
    /// Whether detail, range and voids of a tiled map are estimated from its overviews: a remote
    /// raster without a level file next to it.
    bool isEstimated() const noexcept
    {
        return storage_ == MapStorage::Tiled && !levels_.has_value();
    }
    /// Whether `error`, which finish() failed with, is damage to prepared files rather than to the
    /// user's raster.
    bool isDamageToPrepared(const Error& error) const;
    /// Removes the prepared files if they lie in the folder of prepared maps and no program uses
    /// them. The user's own files stay.
    Status discardPrepared();

    /// Statistics of all samples: measured when the map was prepared, estimated, or from a scan of
    /// the file.
    Result<SampleStatistics> statistics(JobMonitor& monitor);

    // Each of the following takes the raster out of this object.

    /// The map; its storage must not be NeedsOverviews.
    Result<std::shared_ptr<const Map>> finish(JobMonitor& monitor);
    OpenRaster takeRaster() && { return std::move(raster_); }

private:
    // Tiles of the whole map, and its statistics.
    struct Tiles {
        std::shared_ptr<const TileSource> source;
        std::shared_ptr<const MapLevels> levels;
    };

    MapOpening(OpenRaster raster, const MapResources& resources);

    Status choose();
    Status chooseStorage();
    Result<bool> useAdjacentLevels();
    bool usePrepared();
    bool usePreparedAt(const std::string& path, bool is_copy);
    Result<std::shared_ptr<const GeotiffTileSource>> tiledRaster() const;
    Result<Tiles> tilesWithLevels() const;
    Result<Tiles> estimatedTiles(JobMonitor& monitor) const;
    Result<Tiles> openTiles(JobMonitor& monitor) const;
    std::shared_ptr<const TileSource> cachedTiles(std::shared_ptr<const TileSource> source,
                                                  const char* what) const;
    Result<std::shared_ptr<const Map>> finishTiled(JobMonitor& monitor);

    OpenRaster raster_;
    MapResources resources_;
    std::vector<std::string> notices_;
    MapStorage storage_ = MapStorage::InMemory;
    std::shared_ptr<const GeotiffTileSource> in_place_; // null: cannot be read in tiles as it is
    std::optional<RasterLevels> levels_;
    OpenFiles open_files_;         // what choose() opened
    std::string prepared_path_{};  // in the folder of prepared maps; empty: not from there
    bool is_copy_ = false;         // tiles are read from a copy at prepared_path_
    std::optional<FileLock> lock_; // protects prepared_path_ from removal; finish() takes it
};

} // namespace marsview
