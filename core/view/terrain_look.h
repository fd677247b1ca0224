// How the terrain is colored and lit.
#pragma once

#include "core/base/angle.h"
#include "core/geo/frames.h"
#include "core/terrain/heightfield.h"

#include <optional>

namespace marsview {

enum class ShadingMode {
    Tint,      // ramp colors for elevation, with hillshade
    Hillshade, // hillshade only
    Slope,     // ramp colors for slope
};

/// The gray of fully lit terrain in the mode Hillshade, as a fraction of white.
inline constexpr double kHillshadeWhite = 0.92;

/// What the light is fixed in.
enum class LightFrame {
    View, // azimuth and altitude where the camera looks
    Body, // the sun stands over a place of the body; flat maps have the light of the view
};

/// Shares of the legend's color: a place in the dark has kNightShare of it, and a place with the
/// sun overhead has both.
inline constexpr double kSunShare = 0.92;
inline constexpr double kNightShare = 0.08;

struct TerrainLook {
    ShadingMode mode = ShadingMode::Tint;
    bool has_contours = false;
    double contour_interval_m = 0.0;             // 0: automatic
    Angle light_azimuth = Angle::degrees(315.0); // direction of the light source, clockwise from
                                                 // north
    Angle light_altitude = Angle::degrees(45.0); // above the horizon
    LightFrame light_frame = LightFrame::View;
    /// Where the sun is overhead while the light is fixed on the body: at 0° N, 0° E if empty. Kept
    /// while it is not.
    std::optional<GeographicPoint> subsolar{};

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
