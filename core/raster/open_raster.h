// Opens a raster by its name, with the user's overrides.
#pragma once

#include "core/base/result.h"
#include "core/geo/georeference.h"
#include "core/raster/raster_file.h"
#include "core/raster/raster_info.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace marsview {

/// A raster and the user's overrides of its metadata: enough to open it again.
struct RasterSpec {
    std::string path;
    int band = 1; // counted from 1
    RasterOverrides overrides{};
    bool operator==(const RasterSpec&) const = default;
};

/// An open raster. For one thread at a time.
///
///     Result<OpenRaster> raster = openRaster({.path = "mars.tif"});
///     if (raster) { use(raster->info, raster->file.readWindow(window, raster->voids())); }
struct OpenRaster {
    RasterSpec spec;
    RasterFile file; // file.info() has the metadata of the file itself
    RasterInfo info; // with the overrides of `spec`

    VoidRule voids() const { return {info.nodata}; }
    /// The size of all samples, uncompressed.
    std::uint64_t sampleBytes() const
    {
        return std::uint64_t{info.columns} * info.rows * marsview::sampleBytes(info.type);
    }
};

/// Opens the file, as RasterFile::open() does, and applies the overrides. Errors begin with the
/// path. Blocks on the disk: not for the GUI thread.
Result<OpenRaster> openRaster(const RasterSpec& spec);

/// The metadata of the file, with overrides. Errors begin with the path of `spec`.
Result<RasterInfo> infoWithOverrides(const RasterInfo& file_info, const RasterSpec& spec);

/// The placement that `info` describes; one map unit per pixel if it has none.
Georeference georeferenceOf(const RasterInfo& info);
/// The same for columns × rows samples that share the area of `info` evenly.
Georeference georeferenceOf(const RasterInfo& info, std::size_t columns, std::size_t rows);

} // namespace marsview
