#include "core/contact/mesh_surface.h"

#include "core/contact/mesh_surface_definitions.h"

namespace marsview {

template class BasicMeshSurface<TriangleMesh>;

} // namespace marsview
