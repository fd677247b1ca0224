#include "core/contact/body_surface.h"

#include "core/contact/mesh_surface_definitions.h"
#include "core/mesh/mesh_cast_definitions.h"

namespace marsview {

template class BasicMeshSurface<BodyMesh>;

} // namespace marsview
