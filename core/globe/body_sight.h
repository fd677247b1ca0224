// The part of a body that a camera sees, on a map of the whole body.
#pragma once

#include "core/geo/body.h"
#include "core/geo/frames.h"
#include "core/globe/polar_plane.h"
#include "core/view/camera.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace marsview {

/// Places in equal steps of longitude, from -180° to 180°, and latitude, from 90° to -90°, both
/// ends included; or of the square around the disc of a polar overview. Assumes that the terrain
/// lies on the ellipsoid.
struct BodySight {
    std::size_t columns = 2;
    std::size_t rows = 2;
    std::optional<PolarPlane> plane;
    std::vector<float> margins; // row by row: positive where the place is in the picture

    float margin(std::size_t column, std::size_t row) const noexcept
    {
        return margins[row * columns + column];
    }
    GeographicPoint placeAt(double column, double row) const noexcept;
};

/// `columns` and `rows` are at least 2. Some 20 ns a place.
BodySight bodySight(const CameraPose& pose,
                    const Ellipsoid& ellipsoid,
                    const Viewport& viewport,
                    std::size_t columns,
                    std::size_t rows);
/// `side` × `side` places around a pole.
BodySight bodySight(const CameraPose& pose,
                    const Ellipsoid& ellipsoid,
                    const Viewport& viewport,
                    const PolarPlane& plane,
                    std::size_t side);

/// The lines around what is in the picture, in pieces that cross half a step at most.
std::vector<std::array<GeographicPoint, 2>> edgesOf(const BodySight& sight);

/// The fraction of the surface of the body, or of the disc of a polar overview, that is in the
/// picture, 0 … 1, to the width of a step.
double shareOfBody(const BodySight& sight);

} // namespace marsview
