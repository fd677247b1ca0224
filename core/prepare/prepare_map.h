// Builds the files through which a raster larger than memory is viewed and touched.
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
    /// The tiled GeoTIFF to write; empty if the raster can be used in place.
    std::string raster_path{};
    /// The level file; empty: next to the tiled raster.
    std::string level_path{};
    TiledGeoTiffJob::WhenBusy when_busy = TiledGeoTiffJob::WhenBusy::Fail;
    /// For existing files that belong to the raster: use them as they are; check all checksums and
    /// rebuild damaged files; or rebuild always.
    enum class WhenThere : std::uint8_t { Trust, Check, Replace };
    WhenThere when_there = WhenThere::Trust;
    TiledGeoTiffJob::Order order = TiledGeoTiffJob::Order::AsMade; // of the tiled GeoTIFF
    std::chrono::milliseconds checkpoint_interval = TiledGeoTiffJob{}.checkpoint_interval;
};

struct PrepareReport {
    bool is_source_used = false; // the raster was tiled and had overviews already
    std::string raster_path;
    std::string level_path;
    TiledGeoTiffReport copy; // of the tiled GeoTIFF, if one was written
    std::uint64_t samples = 0;
    double copy_seconds = 0.0;
    double level_seconds = 0.0;
    double check_seconds = 0.0;
    bool are_levels_there = false;  // they existed already, and nothing was done
    std::vector<std::string> notes; // sentences for the user, including those of the copy
};

/// Refuses a remote raster: it is read directly, and nothing can be written next to it.
Status checkIsLocal(const RasterSpec& spec);

/// Whether the tiles of the raster can be read from the raster itself.
bool canBeUsedInPlace(const OpenRaster& raster);

/// The path of the prepared map of a raster in a folder of prepared maps; neither need exist.
/// NotFound if `folder` is empty: prepared maps are not kept.
Result<std::string> preparedPathFor(const OpenRaster& raster, const std::filesystem::path& folder);

/// Copies the raster into a tiled GeoTIFF unless it is used in place, then builds its level file.
/// Each file appears complete or not at all. Existing files of the raster are kept unless they are
/// damaged or to be replaced. A damaged raster that is used in place is an error, because it cannot
/// be rebuilt. After a cancellation, the next call resumes the work. On all cores; not for the GUI
/// thread. Errors name the file and say what to do.
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
