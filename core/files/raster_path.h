// From the path that a user gives to the name that GDAL opens.
#pragma once

#include "core/base/result.h"

#include <string>
#include <vector>

namespace marsview {

/// The names to try in turn for `path`: the path itself, then its companions: the label of bare
/// data (.img → .lbl, .xml), the data of a header (.hdr → .dem,
/// .flt, …), the rasters in an archive in the order of rastersInArchive(). Companions are found
/// whatever the case of their extension. NotFound or Unreadable where the path is a file name and
/// there is no such readable, non-empty file. Addresses ("https://…", "s3://…") become the name
/// that reads them in pieces; other names with a scheme ("NETCDF:…") pass unchecked.
Result<std::vector<std::string>> rasterNamesFor(const std::string& path);

bool isFolder(const std::string& path);

/// Whether GDAL reads what has that name out of an archive, by unpacking it.
bool isInArchive(const std::string& name);

/// Of ASCII letters: for extensions, which are written in either case.
std::string lowerCase(std::string text);

} // namespace marsview
