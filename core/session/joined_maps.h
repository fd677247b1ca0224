// Which maps of a body lie on top of each other.
#pragma once

#include "core/session/body_terrain.h"

#include <cstddef>
#include <vector>

namespace marsview {

/// Whether the areas of two maps have a place in common, voids included. Takes a microsecond or two
/// for each sample of their borders.
bool doOverlap(const BodyTerrain& a, const BodyTerrain& b);

/// The maps among `indexes` that lie on top of each other, directly or by others in between: a set
/// for each such pile, in the order of `indexes`. A map that lies alone is in none.
std::vector<std::vector<std::size_t>> pilesOf(const BodyScene& scene,
                                              const std::vector<std::size_t>& indexes);

} // namespace marsview
