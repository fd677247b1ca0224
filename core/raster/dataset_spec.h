// Which band of which raster to open, and how to read it.
#pragma once

#include "core/raster/raster_info.h"

#include <string>

namespace marsview {

/// What the user asked for: enough to load the same map again.
struct DatasetSpec {
    std::string path;
    int band = 1;
    RasterOverrides overrides{};
    bool operator==(const DatasetSpec&) const = default;
};

} // namespace marsview
