// How the terrain is colored and lit.
#pragma once

#include "core/base/angle.h"
#include "core/terrain/heightfield.h"

namespace marsview {

enum class ShadingMode {
    Tint,      // ramp colors for elevation, with hillshade
    Hillshade, // hillshade only
    Slope,     // ramp colors for slope
};

/// The gray of fully lit terrain in the mode Hillshade, as a fraction of white.
inline constexpr double kHillshadeWhite = 0.92;

struct TerrainLook {
    ShadingMode mode = ShadingMode::Tint;
    bool has_contours = false;
    double contour_interval_m = 0.0;             // 0: automatic
    Angle light_azimuth = Angle::degrees(315.0); // direction of the light source, clockwise from
                                                 // north
    Angle light_altitude = Angle::degrees(45.0); // above the horizon

    bool operator==(const TerrainLook&) const = default;
};

/// A round interval (1, 2, 5 × 10^n m) for contour lines: some 12 to 30 lines over the whole range,
/// and finer ones near the camera, so that terrain with a slope of 1 in 10 has a line about every
/// 40 to 100 pixels. 0 if there are no lines to draw: heights are equal or unknown, or the scale is
/// unknown.
double automaticContourInterval(const HeightRange& range, double meters_per_pixel);

/// The contour interval of a look: 0 without contours. An `exaggeration` (> 0) below 1 enlarges an
/// automatic interval in proportion: such terrain is far steeper than the lines are designed for,
/// for example a grid in degrees read as meters.
double contourInterval(const TerrainLook& look,
                       const HeightRange& range,
                       double meters_per_pixel,
                       double exaggeration = 1.0);

} // namespace marsview
