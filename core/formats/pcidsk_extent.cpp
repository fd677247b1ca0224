#include "core/formats/pcidsk_extent.h"

#include "core/files/gdal_file.h"

#include <cpl_vsi.h>

#include <cstddef>
#include <cstdlib>
#include <limits>

namespace marsview {

std::optional<std::int64_t> pcidskBytes(const std::string& path)
{
    constexpr std::size_t kBegin = 16;
    constexpr std::size_t kEnd = 32;
    constexpr std::int64_t kBlockBytes = 512;
    const GdalFile file = openGdalFile(path);
    std::string header(kEnd, '\0');
    if (!file || VSIFReadL(header.data(), 1, kEnd, file.get()) != kEnd) {
        return std::nullopt;
    }
    const std::int64_t blocks = std::atoll(header.substr(kBegin).c_str());
    return blocks > 0 && blocks < std::numeric_limits<std::int64_t>::max() / kBlockBytes
               ? std::optional(blocks * kBlockBytes)
               : std::nullopt;
}

} // namespace marsview
