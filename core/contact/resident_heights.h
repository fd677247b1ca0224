// Contact surfaces over maps larger than memory.
#pragma once

#include "core/contact/heightfield_surface.h"
#include "core/levels/tiled_terrain.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace marsview {

/// Heights from tiles (scene_heights.h): the same as FilledHeights over the map in memory, to the
/// bit, where the tiles are resident. T is the sample type, or void for any type, which is slower.
template <typename T>
class ResidentHeights {
public:
    using Terrain = TiledTerrain;

    static bool canRead(const TiledTerrain& terrain) noexcept
    {
        if constexpr (std::is_void_v<T>) {
            return true;
        } else {
            return dispatchSampleType(terrain.heights().layout().type,
                                      [](auto zero) { return std::is_same_v<decltype(zero), T>; });
        }
    }

    /// canRead(terrain).
    ResidentHeights(const TiledTerrain& terrain, double exaggeration) noexcept
        : terrain_(&terrain)
        , scale_(terrain.heights().scale())
        , exaggeration_(exaggeration)
    {
        MARSVIEW_CHECK(canRead(terrain));
    }

    [[gnu::always_inline]] double at(std::int32_t column, std::int32_t row) const noexcept
    {
        if constexpr (!std::is_void_v<T>) {
            if (const T* raw = terrain_->plainSample<T>(column, row)) [[likely]] {
                return scaled(*raw);
            }
        }
        return elsewhere(column, row);
    }

    /// The same at the corners of a cell, and around a sample within the map, in the order of
    /// HeightfieldFan: with one lookup if they lie in one tile.
    [[gnu::always_inline]] CellHeights cell(std::int32_t column, std::int32_t row) const noexcept
    {
        if constexpr (!std::is_void_v<T>) {
            std::ptrdiff_t stride = 0;
            if (const T* raw = terrain_->plainPatch<T, 0>(column, row, stride)) [[likely]] {
                return {scaled(raw[0]), scaled(raw[1]), scaled(raw[stride]),
                        scaled(raw[stride + 1])};
            }
        }
        return cellElsewhere(column, row);
    }
    [[gnu::always_inline]] bool around(std::int32_t column,
                                       std::int32_t row,
                                       double& middle,
                                       std::array<double, 6>& ring) const noexcept
    {
        if constexpr (!std::is_void_v<T>) {
            std::ptrdiff_t stride = 0;
            if (const T* raw = terrain_->plainPatch<T, 1>(column, row, stride)) [[likely]] {
                middle = scaled(raw[0]);
                ring = {scaled(raw[1]),  scaled(raw[stride + 1]),  scaled(raw[stride]),
                        scaled(raw[-1]), scaled(raw[-stride - 1]), scaled(raw[-stride])};
                return true;
            }
        }
        return false;
    }

private:
    template <typename Raw>
    double scaled(Raw raw) const noexcept
    {
        return exaggeration_ * scale_.height(static_cast<double>(raw));
    }
    [[gnu::noinline]] CellHeights cellElsewhere(std::int32_t column,
                                                std::int32_t row) const noexcept
    {
        return {at(column, row), at(column + 1, row), at(column, row + 1), at(column + 1, row + 1)};
    }
    // Kept out of the loops that read heights.
    [[gnu::noinline]] double elsewhere(std::int32_t column, std::int32_t row) const noexcept
    {
        return exaggeration_ *
               terrain_->sample(static_cast<std::size_t>(column), static_cast<std::size_t>(row));
    }

    const TiledTerrain* terrain_;
    ElevationScale scale_;
    double exaggeration_;
};

// Instantiated once, in heightfield_surface.cpp.
extern template class BasicHeightfieldSurface<ResidentHeights<void>>;
extern template class BasicHeightfieldSurface<ResidentHeights<std::int16_t>>;
extern template class BasicHeightfieldSurface<ResidentHeights<float>>;

/// A map in tiles. The surface is as constant as its terrain: see ContactModel::terrainChanged.
using TiledHeightfieldSurface = BasicHeightfieldSurface<ResidentHeights<void>>;
/// The same, faster, if ResidentHeights<T>::canRead(terrain).
template <typename T>
using TypedTiledSurface = BasicHeightfieldSurface<ResidentHeights<T>>;

static_assert(ContactSurface<TiledHeightfieldSurface>);
static_assert(ContactSurface<TypedTiledSurface<std::int16_t>>);
static_assert(ContactSurface<TypedTiledSurface<float>>);

} // namespace marsview
