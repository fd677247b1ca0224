// Making of a raster too large to hold the files by which it is looked at and touched.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/prepare/tiled_geotiff.h"
#include "core/raster/open_raster.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace marsview {

struct PrepareJob {
    /// Of the tiled GeoTIFF to make; empty where the raster is one that can be used in place.
    std::string raster_path{};
    /// Of the level file; empty: next to the tiled raster.
    std::string level_path{};
    TiledGeoTiffJob::WhenBusy when_busy = TiledGeoTiffJob::WhenBusy::Fail;
    /// For existing files that belong to the raster: use them as they are; check all checksums and
    /// rebuild damaged files; or rebuild always.
    enum class WhenThere : std::uint8_t { Trust, Check, Replace };
    WhenThere when_there = WhenThere::Trust;
    std::chrono::milliseconds checkpoint_interval = TiledGeoTiffJob{}.checkpoint_interval;
};

struct PrepareReport {
    bool is_source_used = false; // the raster was tiled and had overviews already
    std::string raster_path;
    std::string level_path;
    TiledGeoTiffReport copy; // of the tiled GeoTIFF, where one was made
    std::uint64_t samples = 0;
    double copy_seconds = 0.0;
    double level_seconds = 0.0;
    double check_seconds = 0.0;
    bool are_levels_there = false;  // they were, and nothing was done
    std::vector<std::string> notes; // sentences for the user, those of the copy included
};

/// Refuses a remote raster: it is read where it is, and nothing can be written next to it.
Status checkIsLocal(const RasterSpec& spec);

/// Whether the tiles of the raster can be read where it is.
bool canBeUsedInPlace(const OpenRaster& raster);

/// The path of the prepared map of a raster in a folder of prepared maps; neither need exist.
/// NotFound if `folder` is empty: prepared maps are not kept.
Result<std::string> preparedPathFor(const OpenRaster& raster, const std::filesystem::path& folder);

/// Copies the raster into a tiled GeoTIFF unless it is used in place, then measures it into its
/// level file. Each appears whole or not at all; what is there already and belongs to the raster is
/// not made again, unless it is damaged or to be replaced. A raster that is used in place and is
/// damaged is an error: nothing can make it again. Stopped, the work is gone on with the next time.
/// On all cores; not for the GUI thread. Errors name the file and say what to do.
Result<PrepareReport>
prepareMapFiles(const OpenRaster& raster, const PrepareJob& job, JobMonitor& monitor);

struct FolderJob {
    std::filesystem::path folder;
    std::uint64_t folder_bytes_max = 0; // 0: MapFolder::defaultBytesMax()
    TiledGeoTiffJob::WhenBusy when_busy = TiledGeoTiffJob::WhenBusy::Wait;
    PrepareJob::WhenThere when_there = PrepareJob::WhenThere::Trust;
    std::chrono::milliseconds checkpoint_interval = TiledGeoTiffJob{}.checkpoint_interval;
};

/// As prepareMapFiles(), in the folder of prepared maps: maps marked as damaged are rebuilt, the
/// least recently used maps are removed if that frees enough disk space, and afterwards the folder
/// is trimmed.
Result<PrepareReport>
prepareInFolder(const OpenRaster& raster, const FolderJob& job, JobMonitor& monitor);

/// The remedy for a damaged raster with a level file: the end of a sentence.
std::string remedyFor(const std::string& raster_path, const std::string& level_path);

} // namespace marsview
