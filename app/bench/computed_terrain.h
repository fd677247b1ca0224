// Terrain from a function, in memory.
#pragma once

#include "core/terrain/filled_heightfield.h"

#include <cstddef>
#include <functional>
#include <memory>

namespace marsview {

/// `side` × `side` samples of the heights in meters.
std::shared_ptr<const FilledHeightfield>
computedTerrain(std::size_t side,
                const std::function<double(std::size_t column, std::size_t row)>& height_m);

} // namespace marsview
