// Limits of joining maps.
#pragma once

#include <cstddef>

namespace marsview {

/// Of the maps below another one, as far as they are in tiles: such a map may have more triangles
/// than there is time and memory for.
struct LayerLimits {
    std::size_t covered_faces_max = 100'000'000; // each takes two bits
    std::size_t cut_faces_max = 4'000'000; // of all maps; each takes about 500 bytes while joining
};

} // namespace marsview
