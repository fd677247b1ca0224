// Measurements as tables of text, for spreadsheets and other programs.
#pragma once

#include "core/measure/ground.h"
#include "core/measure/hypsometry.h"
#include "core/session/measurement_features.h"

#include <span>
#include <string>

namespace marsview {

/// Longitude east and latitude in degrees, as maps of the body have them: planetocentric, on the
/// Earth planetographic. x and y on a map without a body.
MapPoint tablePosition(const NamedMeasurement& measurement, GroundPosition position);
MapPoint tablePosition(const NamedMeasurement& measurement, const MeasuredVertex& vertex);

/// "226.2 18.65 21171; 230 20 -1043": the vertices with their positions as above and elevations in
/// meters, in full; "nan" without terrain.
std::string pointsText(const NamedMeasurement& measurement);

/// The points of a profile: distance_m, lon, lat and elevation_m, with full precision; "nan" in
/// gaps. Only the header without such a result.
std::string profileCsv(const NamedMeasurement& profile);

/// The classes of elevation, upward: bounds, area, and the area above the lower bound, both also as
/// shares of the whole. Only the header without terrain.
std::string hypsometryCsv(const Hypsometry& hypsometry);

/// A line for each attitude with a result, with the columns that programs for structural geology
/// read: name, lon, lat, strike, dip, dip_direction, and the errors in degrees and meters.
std::string attitudesCsv(std::span<const NamedMeasurement> measurements);

/// A field of a CSV file, in quotes where RFC 4180 asks for them.
std::string csvField(const std::string& text);

} // namespace marsview
