// Measurements as people read them.
#pragma once

#include "core/geo/coordinate_format.h"
#include "core/session/measurement.h"
#include "ui/text/number_text.h"

#include <QString>

#include <vector>

namespace marsview {

/// "Strike and Dip", as in the menu.
QString measurementName(MeasurementKind kind);

/// "412.3 m", "12.41 km" or "1,203 km": the last digit counts 10^last_place meters; see
/// core/measure/measured_digits.h.
QString measuredLengthText(double length_m, int last_place);
/// The same for areas and volumes, in the powers of meters and kilometers.
QString measuredAreaText(double area_m2, int last_place);
QString measuredVolumeText(double volume_m3, int last_place);
/// "12.3°".
QString measuredAngleText(double degrees, int decimals = 1);

struct MeasureRow {
    QString label;
    QString value;
};

/// What there is to say about a result; empty where it is an error.
std::vector<MeasureRow> measureRows(const MeasurementResult& result, HeightUnit unit);
/// A point of a measurement; empty where there is no such text.
struct MeasurePoint {
    QString position;
    QString elevation;
};

/// The points of a measurement on the map of its layer, in the order in which they were placed.
std::vector<MeasurePoint> measurePoints(const std::vector<MeasuredVertex>& vertices,
                                        const MeasurementResult& result,
                                        const Map& map,
                                        const CoordinateFormat& format,
                                        HeightUnit unit);
/// The same as rows for people: "Point 2", "18.65° N, 226.20° E, 21,171 m". The elevation of a
/// single point is among the results and not repeated.
std::vector<MeasureRow> pointRows(const std::vector<MeasurePoint>& points);
/// The center of a crater or of the points of an attitude on a body; empty for other results.
std::vector<MeasureRow>
centerRows(const MeasurementResult& result, const Map& map, const CoordinateFormat& format);

/// The figure that stands for the whole result, for lists and labels: "≈" before approximate ones.
/// Empty where the result is an error.
QString measureSummary(const MeasurementResult& result, HeightUnit unit);
/// The same with what else belongs to it in a table: depth and d/D of a crater.
QString measureTableText(const MeasurementResult& result, HeightUnit unit);
/// That figure in meters or square meters, or the dip in degrees. NaN where the result is an error.
double measureFigure(const MeasurementResult& result);

} // namespace marsview
