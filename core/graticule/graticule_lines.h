// Meridians and parallels in a picture: steps, lines and places of labels.
#pragma once

#include "core/base/angle.h"
#include "core/geo/coordinate_format.h"
#include "core/geo/frames.h"
#include "core/view/camera.h"

#include <optional>
#include <vector>

namespace marsview {

/// Of two lines, at least, where the camera looks: points of the screen.
inline constexpr double kGraticuleSpacing = 90.0;
/// How far lines reach from where the camera looks, in distances of the camera from there.
inline constexpr double kGraticuleReach = 8.0;
/// Of an axis.
inline constexpr double kGraticuleLinesMax = 80.0;

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

/// Where the value of a line belongs.
struct GraticuleLabel {
    GraticuleAxis axis = GraticuleAxis::Meridian;
    Angle value{};      // as of the line
    ScenePoint place{}; // on the line
    PixelPoint pixel{}; // in the picture
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

/// The point of a line in the picture that is furthest from its middle; for a meridian rather below
/// the middle, for a parallel rather to its left. Where a label belongs.
struct GraticuleEnd {
    ScenePoint place{};
    PixelPoint pixel{}; // in the picture
};

std::optional<GraticuleEnd>
labelEnd(const GraticuleLine& line, const CameraPose& camera, const Viewport& viewport);

} // namespace marsview
