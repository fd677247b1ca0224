// Archives with several rasters: which one is opened.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace marsview {

/// A raster in an archive.
struct ArchiveRaster {
    std::string name; // GDAL's: "/vsizip/maps.zip/dem.tif"
    std::size_t columns = 0;
    std::size_t rows = 0;
};

/// The name under which GDAL reads what is in an archive: of .zip, .tar, .tgz and .tar.gz, and of
/// such a name itself ("/vsizip/maps.zip"). Empty for everything else.
std::string archiveNameFor(const std::string& path);

/// The rasters with elevations in an archive, from archiveNameFor, the one to open first: samples
/// of more than 8 bits before bytes, which are mostly pictures, masks and counts; then the larger
/// one; then by name. Files that belong to another raster, as the data of a label, are left out,
/// and so are color pictures unless there is nothing else. Opens the 64 largest files, if GDAL
/// recognizes them, each behind the guard of open_guard.h. Remembers the last few archives. Any
/// thread.
std::vector<ArchiveRaster> rastersInArchive(const std::string& archive);

/// Says which of several was opened and by which names the others are; empty for one.
std::string archiveNotice(const std::vector<ArchiveRaster>& rasters, const std::string& opened);

} // namespace marsview
