// How a heightfield surface reads its samples: as heights in scene meters.
//
// A policy names the Terrain that it reads (core/terrain/touch_terrain.h), is constructed from it
// and an exaggeration, and has at(column, row). A policy that reads several samples faster at once
// also has cell() and around(), as in resident_heights.h, for terrain in tiles.
#pragma once

#include "core/terrain/filled_heightfield.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
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

/// Samples of type T, where all voids, if any, have one raw value in common. The same heights as
/// FilledHeights, to the bit, in a third of the time.
template <typename T>
class PlainHeights {
public:
    using Terrain = FilledHeightfield;

    static bool canRead(const FilledHeightfield& terrain) noexcept
    {
        const SampleGrid& samples = terrain.heightfield().samples();
        return (!samples.hasVoids() || terrain.voidBits()) && samples.visit([](auto view) {
            return std::is_same_v<decltype(view), GridView<const T>>;
        });
    }

    /// canRead(terrain).
    PlainHeights(const FilledHeightfield& terrain, double exaggeration) noexcept
        : terrain_(&terrain)
        , columns_(terrain.columns())
        , scale_(terrain.heightfield().scale())
        , exaggeration_(exaggeration)
    {
        MARSVIEW_CHECK(canRead(terrain));
        terrain.heightfield().samples().visit([this](auto view) {
            if constexpr (std::is_same_v<decltype(view), GridView<const T>>) {
                samples_ = view.data();
            }
        });
        if (terrain.voidBits()) {
            T raw;
            std::memcpy(&raw, &*terrain.voidBits(), sizeof(raw));
            void_key_ = keyOf(raw);
        }
    }

    [[gnu::always_inline]] double at(std::int32_t column, std::int32_t row) const noexcept
    {
        const T raw =
            samples_[static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column)];
        if (keyOf(raw) == void_key_) [[unlikely]] {
            return elsewhere(column, row);
        }
        return exaggeration_ * scale_.height(static_cast<double>(raw));
    }

private:
    // The raw value as an integer: two NaNs with the same bits are equal.
    static std::int64_t keyOf(T raw) noexcept
    {
        if constexpr (std::is_integral_v<T>) {
            return raw;
        } else {
            static_assert(sizeof(T) == sizeof(std::int32_t));
            return std::bit_cast<std::int32_t>(raw);
        }
    }
    // Kept out of the loops that read heights.
    [[gnu::noinline]] double elsewhere(std::int32_t column, std::int32_t row) const noexcept
    {
        return exaggeration_ *
               terrain_->sample(static_cast<std::size_t>(column), static_cast<std::size_t>(row));
    }

    const T* samples_ = nullptr;
    const FilledHeightfield* terrain_;
    std::size_t columns_;
    ElevationScale scale_;
    double exaggeration_;
    std::int64_t void_key_ = std::numeric_limits<std::int64_t>::min(); // without voids: no sample's
};

} // namespace marsview
