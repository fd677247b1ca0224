// How the terrain is coloured and lit.
#pragma once

#include "core/base/angle.h"
#include "core/terrain/heightfield.h"

namespace marsview {

enum class ShadingMode {
    Tint,      // colours of the ramp for heights, shaded by the light
    Hillshade, // light alone
    Slope,     // colours of the ramp for the steepness of the ground
};

/// The gray of fully lit ground in the mode Hillshade, as a share of white.
inline constexpr double kHillshadeWhite = 0.92;

struct TerrainLook {
    ShadingMode mode = ShadingMode::Tint;
    bool has_contours = false;
    double contour_interval_m = 0.0;             // 0: chosen by what the picture shows
    Angle light_azimuth = Angle::degrees(315.0); // where the light comes from, clockwise from north
    Angle light_altitude = Angle::degrees(45.0); // above the horizon

    bool operator==(const TerrainLook&) const = default;
};

/// A round interval (1, 2, 5 × 10^n m) for contour lines: some 12 to 30 lines over the whole range,
/// and finer ones the nearer the camera is, so that ground rising one in ten has a line about every
/// 40 to 100 pixels. 0 where there is nothing to draw lines of: heights all equal or unknown, or no
/// scale.
double automaticContourInterval(const HeightRange& range, double metres_per_pixel);

/// The interval that a look asks for: 0 without contours. An `exaggeration` (> 0) below 1 makes an
/// automatic interval as much larger: such terrain is far steeper than the lines are meant for, as
/// a grid of degrees that is taken for metres.
double contourInterval(const TerrainLook& look,
                       const HeightRange& range,
                       double metres_per_pixel,
                       double exaggeration = 1.0);

} // namespace marsview
