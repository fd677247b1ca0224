// The form in which a raster larger than memory can be looked at and touched: a tiled GeoTIFF with
// overviews, as other programs read it too.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/raster/raster_info.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace marsview {

struct TiledGeoTiffJob {
    std::string source; // any name that RasterFile opens
    int band = 1;
    RasterOverrides overrides{}; // what the file is to say instead of the source
    std::string path;            // of the result
    enum class WhenBusy : std::uint8_t { Fail, Wait };
    WhenBusy when_busy = WhenBusy::Fail; // another program makes the same file
    enum class WhenThere : std::uint8_t { Keep, Replace };
    WhenThere when_there = WhenThere::Keep; // the file is made from the same source already
    std::uint64_t bytes_after = 0;          // the disk is to have room for, beside the file
    /// How far a stopped job may fall back; more where noting takes long. 0 notes as often as there
    /// is something to note, however long it takes.
    std::chrono::milliseconds checkpoint_interval{3000};
};

struct TiledGeoTiffReport {
    std::vector<std::string> notes; // such as "goes on behind row 20480"; sentences for the user
    std::uint64_t samples = 0;      // of the raster
    std::uint64_t samples_read = 0; // by this call; fewer where it went on from a stopped one
    std::uint64_t bytes = 0;        // of the file
    bool is_there = false;          // it was, and nothing was done
};

/// No tiled GeoTIFF of this raster is larger.
std::uint64_t tiledGeoTiffBytesMax(const RasterInfo& info);

/// Copies a raster of any layout into a tiled BigTIFF (256 × 256, deflate with predictor) with
/// AVERAGE overviews by 2, 4, 8, … until one tile is enough. Samples keep type and bits; CRS,
/// placement (corrected as RasterInfo has it), nodata, mask, scale, offset, unit and vertical datum
/// go along, so that RasterFile finds the same map. A mask marks every void sample.
///
/// The source is read once, in bands of whole rows of tiles, and never written to. Memory: four
/// times 256 rows of samples, some 330 MB for 106 694 columns of int16.
///
/// Works in PATH.part and moves that to PATH when it is whole. Stopped by cancel, a full disk or
/// death of the program, the next call for the same source, untouched since, and settings goes on
/// from the last checkpoint. PATH.lock keeps other programs from the same work. Errors begin with
/// the path that they are about; nothing is published where the source changed meanwhile. Where
/// PATH is made from the same source and settings already, nothing is done, unless it is to be
/// replaced.
Result<TiledGeoTiffReport> writeTiledGeoTiff(const TiledGeoTiffJob& job, JobMonitor& monitor);

/// Whether every tile of a file that writeTiledGeoTiff() made still has the bytes it was written
/// with, by the checksum that deflate gives each; GDAL does not look at all of them. Reads it
/// whole.
bool isWholeTiledGeoTiff(const std::string& path);

} // namespace marsview
