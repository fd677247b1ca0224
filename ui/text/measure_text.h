// Measurements as people read them.
#pragma once

#include "core/session/measurement.h"
#include "ui/text/number_text.h"

#include <QString>

#include <vector>

namespace marsview {

/// "Strike and Dip", as in the menu.
QString measurementName(MeasurementKind kind);

/// "412.3 m", "12.41 km" or "1,203 km": four significant digits.
QString measuredLengthText(double length_m);
/// The same for areas and volumes, in the powers of meters and kilometers.
QString measuredAreaText(double area_m2);
QString measuredVolumeText(double volume_m3);
/// "12.3°".
QString measuredAngleText(double degrees, int decimals = 1);

struct MeasureRow {
    QString label;
    QString value;
};

/// What there is to say about a result; empty where it is an error.
std::vector<MeasureRow> measureRows(const MeasurementResult& result, HeightUnit unit);
/// The figure that stands for the whole result, for lists and labels: "≈" before approximate ones.
/// Empty where the result is an error.
QString measureSummary(const MeasurementResult& result, HeightUnit unit);
/// That figure in meters or square meters, or the dip in degrees. NaN where the result is an error.
double measureFigure(const MeasurementResult& result);

} // namespace marsview
