// Cuts a map out of the maps below it, and closes the steps between maps with walls.
#pragma once

#include "core/base/result.h"
#include "core/body/layer_limits.h"
#include "core/body/layer_patch.h"

#include <cstddef>

namespace marsview {

/// Cuts map `index` out of those below it, which are cut already: what it covers is gone, and faces
/// that meet along its border are linked. Unsupported if the border leads beyond the maps below, or
/// cannot be cut out, TooLarge beyond the limits; then the patch is of no more use.
Status cutOut(LayerPatch& patch, std::size_t index, const LayerLimits& limits, JobMonitor& monitor);

/// Walls between the vertices of all cliffs. Afterwards each vertex has one fan.
void addWalls(LayerPatch& patch);

} // namespace marsview
