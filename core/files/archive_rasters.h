// Chooses the raster to open in an archive with several.
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
    bool operator==(const ArchiveRaster&) const = default;
};

/// GDAL's name for the contents of an archive: for .zip, .tar, .tgz and .tar.gz files, and for such
/// names themselves ("/vsizip/maps.zip"). Empty for everything else.
std::string archiveNameFor(const std::string& path);

/// The rasters with elevations in an archive, from archiveNameFor, the one to open first: samples
/// of more than 8 bits before bytes, which are mostly pictures, masks and counts; then the larger
/// one; then by name. Files that belong to another raster, such as the data of a label, are
/// skipped, and so are color pictures unless there is nothing else. Looks at the 64 largest
/// of the first 2000 files, in a child process (open_probe.h). Caches the results of the last few
/// archives. Any thread.
std::vector<ArchiveRaster> rastersInArchive(const std::string& archive);

/// A notice that names the opened raster and the others by GDAL's names; empty if there is only
/// one.
std::string archiveNotice(const std::vector<ArchiveRaster>& rasters, const std::string& opened);

} // namespace marsview
