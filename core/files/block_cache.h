// The size of GDAL's cache of decoded blocks.
#pragma once

#include <cstddef>

namespace marsview {

/// The limit of GDAL's block cache in bytes: GDAL_CACHEMAX from the environment or GDAL's
/// configuration file, otherwise 32 MiB, or more after allowLargeBlockCache().
std::size_t blockCacheBytes();

} // namespace marsview
