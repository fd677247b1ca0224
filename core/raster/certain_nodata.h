// Nodata that a file does not declare and that cannot be an elevation.
#pragma once

#include "core/raster/raster_info.h"

#include <optional>

namespace marsview {

/// A nodata suggestion that no elevation on any body has: a window may read it as nodata until its
/// user decides. Empty if there is no suggestion, or if it may be an elevation.
std::optional<double> certainNodata(const RasterInfo& info);

} // namespace marsview
