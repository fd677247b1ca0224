// Rasters of which GDAL would hold large blocks, and how they are read instead. Used inside
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
/// cache where the dataset is opened within a DirectReads scope.
bool hasLargePlainStrips(GDALDataset& dataset);

/// What this thread opens while it lives, unless the user's own settings say otherwise.
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

/// Large compressed strips of a TIFF on disk, to be read row by row; nothing where it has none.
std::optional<TiffStrips> largeStripsOf(GDALRasterBand& band, const RasterInfo& info);

/// How much memory a single block takes, where that is so much that people should know: a sentence
/// about the map.
std::optional<std::string> noticeOfLargeBlock(GDALRasterBand& band);

} // namespace marsview
