#include "ui/text/measure_text.h"

#include "core/measure/statistics/profile_statistics.h"
#include "core/session/map.h"
#include "ui/text/coordinate_text.h"

#include <QCoreApplication>

#include <cmath>
#include <limits>
#include <variant>

namespace marsview {
namespace {

constexpr double kKilometersFrom = 1000.0;

// Not named tr(): lupdate would look for texts in its arguments only.
QString measureTr(const char* text)
{
    return QCoreApplication::translate("Measure", text);
}

bool isStrikeKnown(const AttitudeUncertainty& errors)
{
    return errors.strike_error_deg < 180.0;
}

QString missing()
{
    //: In place of a number: the terrain has no data there
    return measureTr(QT_TRANSLATE_NOOP("Measure", "no data"));
}

// Of a power of the meter: 1 a length, 2 an area, 3 a volume.
QString
powerText(double value, int last_place, int power, const QString& small, const QString& large)
{
    if (!std::isfinite(value)) {
        return missing();
    }
    const bool is_large = std::abs(value) >= std::pow(kKilometersFrom, power);
    const WrittenNumber number = writtenNumber(value, last_place, is_large ? 3 * power : 0);
    return leftToRight(
        withUnit(numberText(number.value, number.decimals), is_large ? large : small));
}

// A foot has the digits that a meter has.
QString elevationText(double elevation_m, int last_place, HeightUnit unit)
{
    if (!std::isfinite(elevation_m)) {
        return missing();
    }
    const WrittenNumber number = writtenNumber(inUnit(elevation_m, unit), last_place);
    return leftToRight(withUnit(numberText(number.value, number.decimals), unitSymbol(unit)));
}

QString angleText(double degrees, int last_place)
{
    return measuredAngleText(degrees, -last_place);
}

QString diameterText(const Crater& crater, const MeasuredDigits& digits)
{
    return measuredLengthText(
        crater.diameter_m,
        digits.diameter(crater.diameter_m, crater.hasResiduals() ? crater.rms_m : 0.0));
}

QString depthToDiameterText(const Crater& crater, const MeasuredDigits& digits)
{
    const double ratio = crater.depth_m / crater.diameter_m;
    const int last_place = digits.depthToDiameter(crater);
    return std::isfinite(ratio) ? leftToRight(numberText(ratio, -last_place)) : missing();
}

class Rows {
public:
    Rows(HeightUnit unit, const MeasuredResolution& resolution)
        : unit_(unit)
        , digits_(resolution)
    {}

    void add(const char* label, const QString& value)
    {
        rows_.push_back({measureTr(label), value});
    }
    void addLength(const char* label, double value)
    {
        add(label, measuredLengthText(value, digits_.length(value)));
    }
    // An uncertainty itself.
    void addError(const char* label, double value_m)
    {
        add(label, measuredLengthText(value_m, lastPlace(value_m, value_m)));
    }
    void addElevation(const char* label, double value)
    {
        add(label, elevationText(value, digits_.elevation(value), unit_));
    }
    void addAngle(const char* label, double degrees, int last_place = kSlopePlace)
    {
        add(label, angleText(degrees, last_place));
    }
    std::vector<MeasureRow> take() { return std::move(rows_); }

    // The surface along a line with gaps is unknown.
    void operator()(const Distance& distance)
    {
        addLength(QT_TRANSLATE_NOOP("Measure", "Geodesic distance"), distance.geodesic_m);
        addLength(QT_TRANSLATE_NOOP("Measure", "Along the terrain"),
                  distance.void_m > 0.0 ? std::numeric_limits<double>::quiet_NaN()
                                        : distance.surface_m);
        addLength(QT_TRANSLATE_NOOP("Measure", "Straight line"), distance.straight_m);
        addElevation(QT_TRANSLATE_NOOP("Measure", "Rise"), distance.rise_m);
        if (distance.legs.size() == 1) {
            addAngle(QT_TRANSLATE_NOOP("Measure", "Azimuth"), distance.legs.front().azimuth_deg,
                     digits_.direction(distance.geodesic_m));
            return;
        }
        for (std::size_t i = 0; i < distance.legs.size(); ++i) {
            const LegDistance& leg = distance.legs[i];
            rows_.push_back(
                {measureTr(QT_TRANSLATE_NOOP("Measure", "Leg %1")).arg(i + 1),
                 measureTr(QT_TRANSLATE_NOOP("Measure", "%1 toward %2"))
                     .arg(measuredLengthText(leg.geodesic_m, digits_.length(leg.geodesic_m)),
                          angleText(leg.azimuth_deg, digits_.direction(leg.geodesic_m)))});
        }
    }
    void operator()(const Profile& profile)
    {
        const double end_m = profile.points.empty() ? 0.0 : profile.points.back().distance_m;
        addStatistics(profileStatistics(profile, 0.0, end_m));
    }
    void addStatistics(const ProfileStatistics& part)
    {
        addLength(QT_TRANSLATE_NOOP("Measure", "Geodesic distance"), part.length_m);
        addLength(QT_TRANSLATE_NOOP("Measure", "Along the terrain"),
                  part.gap_m > 0.0 ? std::numeric_limits<double>::quiet_NaN() : part.surface_m);
        addElevation(QT_TRANSLATE_NOOP("Measure", "Lowest"), part.min_m);
        addElevation(QT_TRANSLATE_NOOP("Measure", "Highest"), part.max_m);
        addElevation(QT_TRANSLATE_NOOP("Measure", "Mean"), part.mean_m);
        addElevation(QT_TRANSLATE_NOOP("Measure", "Total ascent"), part.climb_m);
        addElevation(QT_TRANSLATE_NOOP("Measure", "Total descent"), part.descent_m);
        addAngle(QT_TRANSLATE_NOOP("Measure", "Mean slope"), part.mean_slope_deg);
        addAngle(QT_TRANSLATE_NOOP("Measure", "Steepest slope"), part.steepest_deg);
    }
    void operator()(const TerrainArea& area)
    {
        const int area_place = digits_.area(area.geodesic_m2, area.perimeter_m);
        add(QT_TRANSLATE_NOOP("Measure", "Geodesic area"),
            measuredAreaText(area.geodesic_m2, area_place));
        addLength(QT_TRANSLATE_NOOP("Measure", "Perimeter"), area.perimeter_m);
        if (area.crosses_itself) {
            add(QT_TRANSLATE_NOOP("Measure", "Note"),
                measureTr(QT_TRANSLATE_NOOP("Measure", "The border crosses itself")));
            return;
        }
        add(QT_TRANSLATE_NOOP("Measure", "Terrain area"),
            measuredAreaText(area.surface_m2, area_place));
        addElevation(QT_TRANSLATE_NOOP("Measure", "Lowest"), area.min_m);
        addElevation(QT_TRANSLATE_NOOP("Measure", "Highest"), area.max_m);
        addElevation(QT_TRANSLATE_NOOP("Measure", "Mean"), area.mean_m);
        const auto volume = [&](double value_m3) {
            return measuredVolumeText(value_m3, digits_.volume(value_m3, area.geodesic_m2));
        };
        if (area.volume_above_m3) {
            add(QT_TRANSLATE_NOOP("Measure", "Volume above the border's plane"),
                volume(*area.volume_above_m3));
        }
        if (area.volume_below_m3) {
            add(QT_TRANSLATE_NOOP("Measure", "Volume below it"), volume(*area.volume_below_m3));
        }
    }
    void operator()(const Attitude& attitude)
    {
        const AttitudeUncertainty& errors = attitude.uncertainty;
        const int strike_place =
            errors.is_estimated ? anglePlace(errors.strike_error_deg) : kSlopePlace;
        const int dip_place = errors.is_estimated ? anglePlace(errors.dip_error_deg) : kSlopePlace;
        const auto add_direction = [&](const char* name, double direction_deg) {
            if (isStrikeKnown(errors)) {
                addAngle(name, direction_deg, strike_place);
            } else {
                //: The direction of a plane that may be level
                add(name, measureTr(QT_TRANSLATE_NOOP("Measure", "undetermined")));
            }
        };
        add_direction(QT_TRANSLATE_NOOP("Measure", "Strike (right-hand rule)"),
                      attitude.strike_deg);
        addAngle(QT_TRANSLATE_NOOP("Measure", "Dip"), attitude.dip_deg, dip_place);
        add_direction(QT_TRANSLATE_NOOP("Measure", "Dip direction"), attitude.dip_direction_deg);
        if (errors.is_estimated) {
            addAngle(QT_TRANSLATE_NOOP("Measure", "Dip error (95 %)"), errors.dip_error_deg,
                     dip_place);
            addAngle(QT_TRANSLATE_NOOP("Measure", "Strike error (95 %)"), errors.strike_error_deg,
                     strike_place);
        }
        if (attitude.hasResiduals()) {
            addError(QT_TRANSLATE_NOOP("Measure", "RMS distance from the plane"), attitude.rms_m);
        } else {
            addNoErrors();
        }
        add(QT_TRANSLATE_NOOP("Measure", "Points"), countText(attitude.points));
    }
    void operator()(const Crater& crater)
    {
        add(QT_TRANSLATE_NOOP("Measure", "Diameter"), diameterText(crater, digits_));
        const int place = digits_.depth(crater);
        const auto height = [&](double value_m) { return elevationText(value_m, place, unit_); };
        add(QT_TRANSLATE_NOOP("Measure", "Depth"), height(crater.depth_m));
        add(QT_TRANSLATE_NOOP("Measure", "Depth to diameter"),
            depthToDiameterText(crater, digits_));
        add(QT_TRANSLATE_NOOP("Measure", "Rim"), height(crater.rim_m));
        add(QT_TRANSLATE_NOOP("Measure", "Floor"), height(crater.floor_m));
        if (crater.hasResiduals()) {
            addError(QT_TRANSLATE_NOOP("Measure", "RMS distance from the circle"), crater.rms_m);
        } else {
            addNoErrors();
        }
        add(QT_TRANSLATE_NOOP("Measure", "Rim points"), countText(crater.points));
    }
    void operator()(const std::vector<TerrainSlope>& slopes)
    {
        if (slopes.empty()) {
            return;
        }
        addElevation(QT_TRANSLATE_NOOP("Measure", "Elevation"), slopes.front().elevation_m);
        addAngle(QT_TRANSLATE_NOOP("Measure", "Slope"), slopes.front().slope_deg);
        addAngle(QT_TRANSLATE_NOOP("Measure", "Aspect"), slopes.front().aspect_deg);
    }

private:
    void addNoErrors()
    {
        add(QT_TRANSLATE_NOOP("Measure", "Errors"),
            //: In place of errors
            measureTr(QT_TRANSLATE_NOOP("Measure", "three points: no error estimate")));
    }

    HeightUnit unit_;
    MeasuredDigits digits_;
    std::vector<MeasureRow> rows_;
};

struct Summary {
    HeightUnit unit;
    MeasuredDigits digits;

    QString length(double length_m) const
    {
        return measuredLengthText(length_m, digits.length(length_m));
    }
    QString operator()(const Distance& distance) const { return length(distance.geodesic_m); }
    QString operator()(const Profile& profile) const
    {
        return profile.points.empty() ? QString() : length(profile.points.back().distance_m);
    }
    QString operator()(const TerrainArea& area) const
    {
        return measuredAreaText(area.geodesic_m2, digits.area(area.geodesic_m2, area.perimeter_m));
    }
    // Strike/dip, as geologists write it.
    QString operator()(const Attitude& attitude) const
    {
        const AttitudeUncertainty& errors = attitude.uncertainty;
        const QString strike = std::isfinite(attitude.strike_deg) && isStrikeKnown(errors)
                                   ? QStringLiteral("%1").arg(std::lround(attitude.strike_deg), 3,
                                                              10, QLatin1Char('0'))
                                   : QStringLiteral("–");
        const int dip_place = errors.is_estimated ? anglePlace(errors.dip_error_deg) : kSlopePlace;
        return leftToRight(
            QStringLiteral("%1/%2").arg(strike, angleText(attitude.dip_deg, dip_place)));
    }
    QString operator()(const Crater& crater) const
    {
        //: A diameter
        return measureTr(QT_TRANSLATE_NOOP("Measure", "⌀ %1")).arg(diameterText(crater, digits));
    }
    QString operator()(const std::vector<TerrainSlope>& slopes) const
    {
        return slopes.empty() ? QString()
                              : elevationText(slopes.front().elevation_m,
                                              digits.elevation(slopes.front().elevation_m), unit);
    }
};

struct Figure {
    double operator()(const Distance& distance) const { return distance.geodesic_m; }
    double operator()(const Profile& profile) const
    {
        return profile.points.empty() ? 0.0 : profile.points.back().distance_m;
    }
    double operator()(const TerrainArea& area) const { return area.geodesic_m2; }
    double operator()(const Attitude& attitude) const { return attitude.dip_deg; }
    double operator()(const Crater& crater) const { return crater.diameter_m; }
    double operator()(const std::vector<TerrainSlope>& slopes) const
    {
        return slopes.empty() ? std::numeric_limits<double>::quiet_NaN()
                              : slopes.front().elevation_m;
    }
};

} // namespace

QString measurementName(MeasurementKind kind)
{
    switch (kind) {
    case MeasurementKind::Distance:
        return measureTr(QT_TRANSLATE_NOOP("Measure", "Distance"));
    case MeasurementKind::Profile:
        return measureTr(QT_TRANSLATE_NOOP("Measure", "Profile"));
    case MeasurementKind::Area:
        return measureTr(QT_TRANSLATE_NOOP("Measure", "Area and Volume"));
    case MeasurementKind::Attitude:
        return measureTr(QT_TRANSLATE_NOOP("Measure", "Strike and Dip"));
    case MeasurementKind::Crater:
        return measureTr(QT_TRANSLATE_NOOP("Measure", "Crater"));
    case MeasurementKind::Slope:
        break;
    }
    return measureTr(QT_TRANSLATE_NOOP("Measure", "Elevation and Slope"));
}

QString measuredLengthText(double length_m, int last_place)
{
    return powerText(length_m, last_place, 1, QStringLiteral("m"), QStringLiteral("km"));
}

QString measuredAreaText(double area_m2, int last_place)
{
    return powerText(area_m2, last_place, 2, QStringLiteral("m²"), QStringLiteral("km²"));
}

QString measuredVolumeText(double volume_m3, int last_place)
{
    return powerText(volume_m3, last_place, 3, QStringLiteral("m³"), QStringLiteral("km³"));
}

QString measuredAngleText(double degrees, int decimals)
{
    return std::isfinite(degrees) ? leftToRight(numberText(degrees, decimals) + QStringLiteral("°"))
                                  : missing();
}

std::vector<MeasureRow> measureRows(const MeasurementResult& result, HeightUnit unit)
{
    Rows rows(unit, result.resolution);
    if (result.values) {
        std::visit(rows, *result.values);
    }
    return rows.take();
}

std::vector<MeasurePoint> measurePoints(const std::vector<MeasuredVertex>& vertices,
                                        const MeasurementResult& result,
                                        const Map& map,
                                        const CoordinateFormat& format,
                                        HeightUnit unit)
{
    const MeasuredDigits digits(result.resolution);
    std::vector<MeasurePoint> points;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        points.push_back(
            {.position = positionText(format, map, vertices[i]),
             .elevation = i < result.elevations_m.size()
                              ? elevationText(result.elevations_m[i],
                                              digits.elevation(result.elevations_m[i]), unit)
                              : QString()});
    }
    return points;
}

std::vector<MeasureRow> pointRows(const std::vector<MeasurePoint>& points)
{
    if (points.size() == 1) {
        return {{measureTr(QT_TRANSLATE_NOOP("Measure", "Position")), points.front().position}};
    }
    std::vector<MeasureRow> rows;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const MeasurePoint& point = points[i];
        rows.push_back({//: %1 is a number
                        measureTr(QT_TRANSLATE_NOOP("Measure", "Point %1")).arg(i + 1),
                        point.elevation.isEmpty()
                            ? point.position
                            //: A point: %1 is a position, %2 an elevation
                            : measureTr(QT_TRANSLATE_NOOP("Measure", "%1, %2"))
                                  .arg(point.position, point.elevation)});
    }
    return rows;
}

std::vector<MeasureRow>
centerRows(const MeasurementResult& result, const Map& map, const CoordinateFormat& format)
{
    const auto* crater = result.values ? std::get_if<Crater>(&*result.values) : nullptr;
    const auto* attitude = result.values ? std::get_if<Attitude>(&*result.values) : nullptr;
    const auto& crs = map.georeference().crs();
    const auto ellipsoid = crs ? crs->ellipsoid() : std::nullopt;
    if (!ellipsoid || (crater == nullptr && attitude == nullptr)) {
        return {};
    }
    const DrawnVertex center =
        Ground::onEllipsoid(*ellipsoid)
            .geographic(crater != nullptr ? crater->center : attitude->center);
    return {{measureTr(QT_TRANSLATE_NOOP("Measure", "Center")), positionText(format, map, center)}};
}

QString measureSummary(const MeasurementResult& result, HeightUnit unit)
{
    if (!result.values) {
        return {};
    }
    const QString text =
        std::visit(Summary{unit, MeasuredDigits(result.resolution)}, *result.values);
    return result.is_approximate && !text.isEmpty() ? leftToRight(QStringLiteral("≈ ") + text)
                                                    : text;
}

QString measureTableText(const MeasurementResult& result, HeightUnit unit)
{
    const QString summary = measureSummary(result, unit);
    const auto* crater = result.values ? std::get_if<Crater>(&*result.values) : nullptr;
    if (crater == nullptr) {
        return summary;
    }
    const MeasuredDigits digits(result.resolution);
    //: A crater: %1 is its diameter, %2 its depth, %3 depth to diameter
    return measureTr(QT_TRANSLATE_NOOP("Measure", "%1, depth %2, d/D %3"))
        .arg(summary, elevationText(crater->depth_m, digits.depth(*crater), unit),
             depthToDiameterText(*crater, digits));
}

double measureFigure(const MeasurementResult& result)
{
    return result.values ? std::visit(Figure{}, *result.values)
                         : std::numeric_limits<double>::quiet_NaN();
}

} // namespace marsview
