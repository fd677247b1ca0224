// Meridians and parallels on the terrain of the flat map.
#pragma once

#include "core/geo/body.h"
#include "core/geo/coordinate_format.h"
#include "core/graticule/graticule_lines.h"
#include "core/session/scene_surface.h"
#include "core/view/camera.h"

namespace marsview {

struct GraticuleOptions {
    Viewport viewport{};
    double pixels_per_point = 1.0;
    double exaggeration = 1.0;
    AngleNotation notation = AngleNotation::DecimalDegrees;
    LatitudeKind latitudes = LatitudeKind::Planetocentric;
};

/// The lines in a picture, at least 90 points of the screen apart where the camera looks. They end
/// where there is no terrain, and eight times as far from the camera's target as the camera is.
///
/// Positions are computed in double in the scene, and lie within a fifth of a pixel of the true
/// curve. Empty for maps without longitudes. Calls PROJ some hundred times: a few milliseconds.
Graticule
graticuleOf(const SceneSurface& ground, const OrbitCamera& camera, const GraticuleOptions& options);

} // namespace marsview
