// How much of a body maps cover.
#pragma once

#include <span>

namespace marsview {

class Georeference;

/// The share of their body's surface, 0 to 1, that is within the pixels of at least one of the
/// rasters, with or without data. All are on the same known body. Counted at 4096 places, evenly
/// spread over it, with an error below 0.002; takes milliseconds per raster.
double coveredShare(std::span<const Georeference* const> rasters);

} // namespace marsview
