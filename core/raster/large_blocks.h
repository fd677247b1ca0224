// Rasters whose large blocks GDAL would keep in memory, and another way to read them. Used inside
// core/raster only.
#pragma once

#include "core/raster/raster_info.h"
#include "core/raster/tiff_strips.h"

#include <memory>
#include <optional>
#include <string>

class GDALDataset;
class GDALRasterBand;

namespace marsview {

/// Whether these are large strips of an uncompressed TIFF: rows of them are read without the block
/// cache if the dataset is opened within a DirectReads scope.
bool hasLargePlainStrips(GDALDataset& dataset);

/// Applies to datasets opened on this thread during its lifetime, unless the user's settings
/// differ.
class DirectReads {
public:
    DirectReads();
    ~DirectReads();
    DirectReads(const DirectReads&) = delete;
    DirectReads& operator=(const DirectReads&) = delete;

private:
    struct Setting;
    std::unique_ptr<Setting> setting_;
};

/// Large compressed strips of a TIFF on disk, to be read row by row; empty if it has none.
std::optional<TiffStrips> largeStripsOf(GDALRasterBand& band, const RasterInfo& info);

/// A notice about the memory that a single block takes, if it is very large.
std::optional<std::string> noticeOfLargeBlock(GDALRasterBand& band);

} // namespace marsview
