// The first hit of a ray on the surface at full resolution.
#pragma once

#include "core/geo/frames.h"
#include "core/geo/scene_frame.h"
#include "core/terrain/heightfield.h"
#include "core/terrain/min_max_pyramid.h"

#include <optional>

namespace marsview {

/// A half-line over the grid: position and height at parameter t are affine in t >= 0.
struct GridRay {
    GridPoint origin{};
    double origin_height_m = 0.0;
    double columns_per_t = 0.0;
    double rows_per_t = 0.0;
    double height_per_t_m = 0.0;
};

/// A ray of the scene in grid coordinates, with the same parameter: grid and height are affine in
/// scene coordinates. `exaggeration` > 0.
GridRay gridRay(const ScenePoint& origin,
                const Vec3& direction,
                const SceneFrame& frame,
                double exaggeration);

struct RayHit {
    GridPoint grid;
    double height_m = 0.0; // of the surface, not exaggerated
    double t = 0.0;        // along the ray
};

/// The first point with t >= 0 that the ray shares with the surface, from either side. Rays find no
/// gap between triangles; triangles with a void corner are holes. Edges and corners count if their
/// own samples are valid, as in Heightfield::height. A ray that lies in the surface hits where it
/// enters it.
///
/// Error against exact arithmetic: 1e-9 of a cell and 8 ulp of the largest height, for grid
/// coordinates up to 1e6. Cost: logarithmic in the length of the ray clear of the terrain, linear
/// in the number of cells whose blocks (MinMaxPyramid) it grazes. No allocation.
///
/// `pyramid` was built from `heightfield`.
std::optional<RayHit>
castRay(const Heightfield& heightfield, const MinMaxPyramid& pyramid, const GridRay& ray);

} // namespace marsview
