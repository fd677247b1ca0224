// Maps on top of each other on their body as contact models see them (contact_surface.h).
#pragma once

#include "core/body/layered_mesh.h"
#include "core/contact/body_below.h"
#include "core/contact/mesh_surface.h"

namespace marsview {

/// As BodySurface. The walls where a map ends over another one are faces like all others: a proxy
/// meets a step there.
using LayeredSurface = BasicMeshSurface<LayeredMesh>;

// Instantiated once, in layered_surface.cpp.
extern template class BasicMeshSurface<LayeredMesh>;

static_assert(ContactSurface<LayeredSurface>);

/// As over a BodySurface.
double clearanceOver(const LayeredSurface& surface, const ScenePoint& point) noexcept;
BodyBelow
belowOn(const LayeredSurface& surface, const ScenePoint& point, double level_m = 0.0) noexcept;

} // namespace marsview
