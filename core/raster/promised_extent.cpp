#include "core/raster/promised_extent.h"

#include "core/formats/netcdf_extent.h"
#include "core/formats/pcidsk_extent.h"

#include <cpl_string.h>

namespace marsview {
std::optional<PromisedExtent> promisedExtentOf(GDALDataset& dataset, const RasterInfo& info)
{
    const CPLStringList files(info.driver == "netCDF" || info.driver == "PCIDSK" ||
                                      info.driver == "PNM"
                                  ? dataset.GetFileList()
                                  : nullptr);
    if (files.Count() == 0) {
        return std::nullopt;
    }
    std::optional<std::int64_t> bytes;
    if (info.driver == "netCDF") {
        if (const auto classic = classicNetcdfBytes(files[0])) {
            bytes = static_cast<std::int64_t>(*classic);
        }
    } else if (info.driver == "PCIDSK") {
        bytes = pcidskBytes(files[0]);
    } else { // the samples after the header
        bytes = static_cast<std::int64_t>(info.columns * info.rows * sampleBytes(info.type));
    }
    return bytes ? std::optional<PromisedExtent>({files[0], *bytes}) : std::nullopt;
}

} // namespace marsview
