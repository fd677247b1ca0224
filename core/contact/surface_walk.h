// The surface-walk contact model: exact descent to the goal, once an update.
#pragma once

#include "core/contact/point_proxy.h"
#include "core/contact/steepest_descent.h"

namespace marsview {

/// Each update takes the steepest way over the surface to a local minimum, as if the goal had
/// jumped to where it is.
template <ContactSurface S>
using SurfaceWalk = PointProxy<S, SteepestDescent<S>>;

} // namespace marsview
