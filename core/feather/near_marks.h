// Distances on a grid to the nearest of some marked samples.
#pragma once

#include "core/base/grid_view.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace marsview {

/// The squared distance in cells from each sample to the nearest sample whose mark is not 0, and
/// `reach`² where that is not nearer than `reach`. `marks` has a margin of `reach` samples on all
/// sides, which the result lacks. Exact; row by row.
std::vector<std::uint32_t> squaredDistances(GridView<const std::uint8_t> marks, std::size_t reach);

} // namespace marsview
