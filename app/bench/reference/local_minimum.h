// Whether a proxy is where no way leads closer to its goal: a check that knows no contact model.
#pragma once

#include "core/contact/heightfield_surface.h"

namespace marsview {

/// The largest cosine between the way to the goal and a direction of the tangent cone at `proxy`
/// of the space on and above the surface: the ways to the corners of the triangles that hold the
/// proxy, and the way up, whose cones that space is made of. Positive: the proxy is not at a local
/// minimum of the distance to the goal. 0 or less, up to rounding: it is.
///
/// Knows only the samples and the coordinates of the two; the goal is to be clamped to the grid.
/// Allocates nothing; any thread.
double steepestCosine(const HeightfieldSurface& surface,
                      const ScenePoint& proxy,
                      const ScenePoint& goal) noexcept;

/// The goal as a contact model sees it: clamped to the grid.
ScenePoint clampedGoal(const HeightfieldSurface& surface, const ScenePoint& goal) noexcept;

} // namespace marsview
