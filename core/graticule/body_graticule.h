// Meridians and parallels on the terrain of a body.
#pragma once

#include "core/geo/body.h"
#include "core/geo/coordinate_format.h"
#include "core/globe/body_camera.h"
#include "core/globe/body_navigation.h"
#include "core/globe/body_view.h"
#include "core/graticule/graticule_lines.h"

#include <vector>

namespace marsview {

struct BodyGraticuleOptions {
    double pixels_per_point = 1.0;
    AngleNotation notation = AngleNotation::DecimalDegrees;
    LatitudeKind latitudes = LatitudeKind::Planetocentric;
};

struct BodyGraticule : Graticule {
    std::vector<GraticuleLabel> labels;
};

/// The lines in a picture, at least 90 points of the screen apart in its middle, in the body-fixed
/// frame. They lie on the terrain, and on the ellipsoid where terrain is missing; they end at the
/// horizon, where the picture has no room between them, and eight times as far from the terrain in
/// the middle of the picture as the eye is.
///
/// The target of the camera may be above or below the terrain. The relief of `view` contains all
/// heights of `ground`. At a pole, only meridians of every 30° meet.
///
/// Labels are at the edge of the picture; where much of the body is seen, they are along the
/// meridian and the parallel that run past its middle.
BodyGraticule bodyGraticule(const BodyCamera& camera,
                            const BodyView& view,
                            const BodyGround& ground,
                            const BodyGraticuleOptions& options);

} // namespace marsview
