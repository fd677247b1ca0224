// Checks, independently of the contact models, that no direction leads the proxy closer to its
// goal.
#pragma once

#include "core/body/body_mesh.h"
#include "core/contact/heightfield_surface.h"
#include "core/geo/georeference.h"

namespace marsview {

/// The largest cosine between the vector to the goal and a direction of the tangent cone, at
/// `proxy`, of the space on and above the surface. The directions to the corners of the triangles
/// that contain the proxy and the upward direction span that cone. Positive: the proxy is not at a
/// local minimum of the distance to the goal. 0 or less, up to rounding: it is.
///
/// Uses only the samples and the two positions; the goal must be clamped to the grid. Allocates
/// nothing; any thread.
double steepestCosine(const HeightfieldSurface& surface,
                      const ScenePoint& proxy,
                      const ScenePoint& goal) noexcept;

/// The same on a body, where up is the ellipsoid's normal at the proxy. Of `mesh` only the points
/// of faces are used, and `georeference` is that of its map. Not for proxies at the border of a
/// map.
double steepestCosine(const BodyMesh& mesh,
                      const Georeference& georeference,
                      const ScenePoint& proxy,
                      const ScenePoint& goal);

/// The goal as a contact model sees it: clamped to the grid.
ScenePoint clampedGoal(const HeightfieldSurface& surface, const ScenePoint& goal) noexcept;

} // namespace marsview
