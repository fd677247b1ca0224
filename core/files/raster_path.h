// Converts a user's path to the names that GDAL opens.
#pragma once

#include "core/base/result.h"

#include <string>
#include <vector>

namespace marsview {

/// The names to try in turn for `path`: the path itself, then its companions: the label of bare
/// data (.img → .lbl, .xml), the data of a header (.hdr → .dem, .flt, …), the rasters in an archive
/// in the order of rastersInArchive(). The case of a companion's extension is ignored. NotFound or
/// Unreadable if the path is a file name without a readable, non-empty file. Addresses
/// ("https://…", "s3://…") become the name that reads them in pieces; other names with a scheme
/// ("NETCDF:…") pass unchecked.
Result<std::vector<std::string>> rasterNamesFor(const std::string& path);

/// Whether it is a name of GDAL rather than a path: one with a scheme ("NETCDF:file:variable") or
/// in a virtual file system ("/vsizip/maps.zip/dem.tif").
bool isGdalName(const std::string& path);

bool isFolder(const std::string& path);

/// Whether the name is one of a file in an archive, which GDAL unpacks to read it.
bool isInArchive(const std::string& name);

/// Of ASCII letters: for extensions, which are written in either case.
std::string lowerCase(std::string text);

} // namespace marsview
