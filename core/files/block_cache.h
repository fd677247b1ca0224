// What GDAL holds of decoded blocks.
#pragma once

#include <cstddef>

namespace marsview {

/// How many bytes of decoded blocks GDAL may hold: what the user set as GDAL_CACHEMAX, in the
/// environment or in GDAL's configuration file, else 32 MiB, or more after allowLargeBlockCache().
std::size_t blockCacheBytes();

} // namespace marsview
