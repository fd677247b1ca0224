// The format of prepared rasters larger than memory: a tiled GeoTIFF with overviews, which other
// programs can read too. GDAL creates the file and libtiff stores the tiles; the order of the work
// is our own because GDAL's copies cannot resume after a kill and read the source once per
// overview.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/raster/raster_info.h"
#include "core/sources/source_identity.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace marsview {

struct TiledGeoTiffJob {
    std::string source; // any name that RasterFile opens
    int band = 1;
    RasterOverrides overrides{}; // replace the source's values in the file
    std::string path;            // of the result
    enum class WhenBusy : std::uint8_t { Fail, Wait };
    WhenBusy when_busy = WhenBusy::Fail; // if another program is writing the same file
    enum class WhenThere : std::uint8_t { Keep, Replace };
    WhenThere when_there = WhenThere::Keep; // if the file exists from the same source
    /// The order of the tiles: as they are made, row by row with the overviews between them, or the
    /// overviews first, as in a cloud-optimized GeoTIFF. The latter writes the file a second time.
    enum class Order : std::uint8_t { AsMade, OverviewsFirst };
    Order order = Order::AsMade;
    std::uint64_t bytes_after = 0; // that must remain free in addition to the file
    /// The work that an interruption may lose; more if checkpoints are slow. 0 writes a checkpoint
    /// at every opportunity, however long it takes.
    std::chrono::milliseconds checkpoint_interval{3000};
};

struct TiledGeoTiffReport {
    std::vector<std::string> notes; // sentences for the user
    std::uint64_t samples = 0;      // of the raster
    std::uint64_t samples_read = 0; // by this call; fewer if it resumed an interrupted one
    std::uint64_t bytes = 0;        // of the file
    bool is_there = false;          // it existed already, and nothing was done
};

/// Identifies the source and the settings of a file: equal if the file need not be made again. The
/// location of the source is not part of it.
std::string tiledGeoTiffKey(const RasterInfo& info, const SourceIdentity& source);

/// An upper bound on the size of a tiled GeoTIFF of this raster.
std::uint64_t tiledGeoTiffBytesMax(const RasterInfo& info);

/// Copies a raster of any layout into a tiled BigTIFF (256 × 256, deflate with predictor) with
/// AVERAGE overviews by 2, 4, 8, … until one tile is enough. Samples keep their type and bits. CRS,
/// placement (as corrected in RasterInfo), nodata, mask, scale, offset, unit and vertical datum are
/// copied, so that RasterFile reads the same map. A mask marks every void sample.
///
/// The source is read once, in bands of whole rows of tiles, and never written to. Memory: four
/// times 256 rows of samples, some 330 MB for 106 694 columns of int16.
///
/// Writes PATH.part and renames it to PATH when complete. After a cancel, a full disk or a crash,
/// the next call with the same settings and unchanged source resumes from the last checkpoint.
/// PATH.lock excludes other programs. Errors begin with the path that they concern; nothing is
/// published if the source changed during the copy. If PATH already exists from the same source and
/// settings, nothing is done unless replacement is requested.
Result<TiledGeoTiffReport> writeTiledGeoTiff(const TiledGeoTiffJob& job, JobMonitor& monitor);

/// Whether every tile of a file that writeTiledGeoTiff() made still has its original bytes, by the
/// checksum that deflate stores with each; GDAL does not check them all. Reads the whole file.
bool isWholeTiledGeoTiff(const std::string& path);

} // namespace marsview
