// The bounding box of a map in the scene.
#pragma once

#include "core/geo/frames.h"
#include "core/geo/scene_frame.h"
#include "core/terrain/heightfield.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace marsview {

/// An axis-parallel box in scene meters; minimum <= maximum in each axis.
struct SceneBox {
    ScenePoint minimum;
    ScenePoint maximum;

    constexpr ScenePoint center() const noexcept { return (minimum + maximum) * 0.5; }
    double diagonal_m() const noexcept // NOLINT(readability-identifier-naming)
    {
        return length(maximum - minimum);
    }
    /// The longer of the two horizontal sides.
    double extent_m() const noexcept // NOLINT(readability-identifier-naming)
    {
        return std::max(maximum.x - minimum.x, maximum.y - minimum.y);
    }
    std::array<ScenePoint, 8> corners() const noexcept;
};

/// The smallest box around both.
SceneBox united(const SceneBox& a, const SceneBox& b) noexcept;

/// The box around the part of a grid between two opposite corners, including rotated rasters.
SceneBox boxAround(const SceneFrame& frame,
                   GridPoint first,
                   GridPoint last,
                   const HeightRange& range,
                   double exaggeration);

/// The box around the outermost samples of a grid of columns × rows, including rotated rasters.
SceneBox sceneBox(const SceneFrame& frame,
                  std::size_t columns,
                  std::size_t rows,
                  const HeightRange& range,
                  double exaggeration);

} // namespace marsview
