// A map on its body as contact models see it (contact_surface.h).
#pragma once

#include "core/body/body_mesh.h"
#include "core/contact/mesh_surface.h"

namespace marsview {

/// Scene points are in the body-fixed frame (body_positions.h). A model is placed on the surface
/// along the ellipsoid's normal. At the border of a map that does not go around the body the proxy
/// falls off.
using BodySurface = BasicMeshSurface<BodyMesh>;

// Instantiated once, in body_surface.cpp.
extern template class BasicMeshSurface<BodyMesh>;

static_assert(ContactSurface<BodySurface>);

/// The height of a point over the surface straight below it, along the ellipsoid's normal; negative
/// below the surface, NaN outside the map. For the servo thread: about 2 µs.
double clearanceOver(const BodySurface& surface, const ScenePoint& point) noexcept;

} // namespace marsview
