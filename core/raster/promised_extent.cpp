#include "core/raster/promised_extent.h"

#include "core/formats/netcdf_extent.h"

#include <cpl_string.h>
#include <cpl_vsi.h>

#include <cstddef>
#include <cstdlib>
#include <limits>

namespace marsview {
namespace {

// The size in blocks is a field of the header (PCIDSK database file format, "file header").
std::optional<std::int64_t> pcidskBytes(const std::string& path)
{
    constexpr std::size_t kBegin = 16;
    constexpr std::size_t kEnd = 32;
    constexpr std::int64_t kBlockBytes = 512;
    std::string header(kEnd, '\0');
    VSILFILE* const file = VSIFOpenL(path.c_str(), "rb");
    if (file == nullptr) {
        return std::nullopt;
    }
    const bool is_read = VSIFReadL(header.data(), 1, kEnd, file) == kEnd;
    VSIFCloseL(file);
    const std::int64_t blocks = is_read ? std::atoll(header.substr(kBegin).c_str()) : 0;
    return blocks > 0 && blocks < std::numeric_limits<std::int64_t>::max() / kBlockBytes
               ? std::optional(blocks * kBlockBytes)
               : std::nullopt;
}

} // namespace

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
