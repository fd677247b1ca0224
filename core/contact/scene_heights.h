// How a heightfield surface reads its samples: as heights in scene meters.
//
// A policy names the Terrain that it reads (core/terrain/touch_terrain.h), is constructed from it
// and an exaggeration, and has at(column, row). A policy that reads several samples faster at once
// also has cell() and around(), as in resident_heights.h, for terrain in tiles.
#pragma once

#include "core/terrain/filled_heightfield.h"

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace marsview {

/// Any terrain: samples of any type, voids filled.
class FilledHeights {
public:
    using Terrain = FilledHeightfield;

    FilledHeights(const FilledHeightfield& terrain, double exaggeration) noexcept
        : terrain_(&terrain)
        , exaggeration_(exaggeration)
    {}

    double at(std::int32_t column, std::int32_t row) const noexcept
    {
        return exaggeration_ *
               terrain_->sample(static_cast<std::size_t>(column), static_cast<std::size_t>(row));
    }

private:
    const FilledHeightfield* terrain_;
    double exaggeration_;
};

/// Samples of type T without voids. The same heights as FilledHeights, to the bit, in a third of
/// the time.
template <typename T>
class PlainHeights {
public:
    using Terrain = FilledHeightfield;

    static bool canRead(const FilledHeightfield& terrain) noexcept
    {
        const SampleGrid& samples = terrain.heightfield().samples();
        return !samples.hasVoids() && samples.visit([](auto view) {
            return std::is_same_v<decltype(view), GridView<const T>>;
        });
    }

    /// canRead(terrain).
    PlainHeights(const FilledHeightfield& terrain, double exaggeration) noexcept
        : columns_(terrain.columns())
        , scale_(terrain.heightfield().scale())
        , exaggeration_(exaggeration)
    {
        MARSVIEW_CHECK(canRead(terrain));
        terrain.heightfield().samples().visit([this](auto view) {
            if constexpr (std::is_same_v<decltype(view), GridView<const T>>) {
                samples_ = view.data();
            }
        });
    }

    double at(std::int32_t column, std::int32_t row) const noexcept
    {
        const T raw =
            samples_[static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column)];
        return exaggeration_ * scale_.height(static_cast<double>(raw));
    }

private:
    const T* samples_ = nullptr;
    std::size_t columns_;
    ElevationScale scale_;
    double exaggeration_;
};

} // namespace marsview
