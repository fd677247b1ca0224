// The terrain interface that contact surfaces over a map use.
#pragma once

#include <concepts>
#include <cstddef>

namespace marsview {

/// Heights in meters at the samples of a map, without voids, and a hierarchy of maxima whose nodes
/// are those of MinMaxPyramid: sample(c, r) is at most maximum(l, …) of every node that contains
/// it, so that a cast may skip a node that is below it. Read by the servo thread: nothing here
/// allocates, locks, waits or throws, except in terrain for batch work.
///
/// Terrain may change between two updates of a contact model (ContactModel::terrainChanged),
/// never during one.
// clang-format off: version 14 puts every token of a compound requirement on its own line.
template <typename T>
concept TouchTerrain = requires(const T& terrain, std::size_t i)
{
    {
        terrain.columns()
    }
    noexcept->std::same_as<std::size_t>;
    {
        terrain.rows()
    }
    noexcept->std::same_as<std::size_t>;
    {
        terrain.isVoid(i, i)
    }
    noexcept->std::same_as<bool>;
    {
        terrain.sample(i, i)
    }
    noexcept->std::same_as<double>;
    {
        terrain.levelCount()
    }
    noexcept->std::same_as<std::size_t>;
    {
        terrain.maximum(i, i, i)
    }
    noexcept->std::same_as<double>;
};
// clang-format on

} // namespace marsview
