#include "core/contact/layered_surface.h"

#include "core/contact/body_below_definitions.h"

namespace marsview {

template class BasicMeshSurface<LayeredMesh>;

double clearanceOver(const LayeredSurface& surface, const ScenePoint& point) noexcept
{
    return body_below::clearanceOver(surface, point);
}

BodyBelow belowOn(const LayeredSurface& surface, const ScenePoint& point, double level_m) noexcept
{
    return body_below::belowOn(surface, point, level_m);
}

} // namespace marsview
