// The surface-walk contact model: exact descent to the goal, once per update.
#pragma once

#include "core/contact/point_proxy.h"
#include "core/contact/steepest_descent.h"

namespace marsview {

/// Each update takes the steepest descent over the surface to a local minimum, as if the goal had
/// jumped to its new position.
template <ContactSurface S>
using SurfaceWalk = PointProxy<S, SteepestDescent<S>>;

} // namespace marsview
