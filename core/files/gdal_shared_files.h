// GDAL's readers of files on a disk, through shared open files (shared_file.h).
#pragma once

namespace marsview {

/// Replaces GDAL's file system of plain paths by one that opens files for reading with
/// openShared(); everything else is passed to GDAL's own. File systems built on it (/vsizip/,
/// /vsigzip/, …) share open files, too. Libraries that open files themselves, such as netCDF and
/// HDF5, do not. Call it once, before files are opened.
void shareFilesOfGdal();

} // namespace marsview
