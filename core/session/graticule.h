// Meridians and parallels on the terrain of a picture.
#pragma once

#include "core/base/angle.h"
#include "core/geo/body.h"
#include "core/geo/coordinate_format.h"
#include "core/session/scene_surface.h"
#include "core/view/camera.h"

#include <vector>

namespace marsview {

enum class GraticuleAxis {
    Meridian, // constant longitude
    Parallel, // constant latitude
};

/// A connected part of a meridian or parallel in the scene.
struct GraticuleLine {
    GraticuleAxis axis = GraticuleAxis::Meridian;
    /// East-positive longitude in any turn; latitude of the requested kind.
    Angle value{};
    /// On the terrain, close enough that a straight line between two is within a pixel of it.
    std::vector<ScenePoint> points;
};

struct GraticuleOptions {
    Viewport viewport{};
    double pixels_per_point = 1.0;
    double exaggeration = 1.0;
    AngleNotation notation = AngleNotation::DecimalDegrees;
    LatitudeKind latitudes = LatitudeKind::Planetocentric;
};

struct Graticule {
    Angle longitude_step{};
    Angle latitude_step{};
    std::vector<GraticuleLine> lines;
};

/// The smallest step for lines that is at least `least` (> 0): 1, 2 or 5 × 10^n degrees up to 10°,
/// then 15°, 30°, 45° and 90°. With minutes and seconds below a degree: 1, 2, 5, 10, 20 or 30 of
/// them, then 1, 2 or 5 × 10^n seconds.
Angle graticuleStep(AngleNotation notation, Angle least);

/// The lines in a picture, at least 90 points of the screen apart where the camera looks. They end
/// where there is no terrain, and eight times as far from the camera's target as the camera is.
///
/// Positions are computed in double in the scene, and lie within a fifth of a pixel of the true
/// curve. Empty for maps without longitudes. Calls PROJ some hundred times: a few milliseconds.
Graticule
graticuleOf(const SceneSurface& ground, const OrbitCamera& camera, const GraticuleOptions& options);

/// The point of a line in the picture that is furthest from its middle; for a meridian rather below
/// the middle, for a parallel rather to its left. Where a label belongs.
struct GraticuleEnd {
    ScenePoint place{};
    PixelPoint pixel{}; // in the picture
};

std::optional<GraticuleEnd>
labelEnd(const GraticuleLine& line, const OrbitCamera& camera, const Viewport& viewport);

} // namespace marsview
