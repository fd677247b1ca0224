#include "ui/text/coordinate_text.h"

#include "core/session/map.h"

#include <QCoreApplication>
#include <QLocale>
#include <QRegularExpression>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <variant>

namespace marsview {
namespace {

QString tr(const char* text)
{
    return QCoreApplication::translate("marsview", text);
}

bool isEarth(const RasterInfo& info)
{
    return info.body != nullptr && info.body->name == "Earth";
}

QString unitSymbol(const Crs& crs)
{
    return crs.unit() == 1.0 ? QStringLiteral("m") : QString::fromStdString(crs.unitName());
}

QString letterOf(char direction)
{
    switch (direction) {
    case 'S':
        //: South, behind a latitude
        return tr("S");
    case 'E':
        //: East, behind a longitude
        return tr("E");
    case 'W':
        //: West, behind a longitude
        return tr("W");
    default:
        //: North, behind a latitude
        return tr("N");
    }
}

QString fixed(double value, int decimals)
{
    return QLocale().toString(value, 'f', decimals);
}

// With two places before the point. Parts are rounded already: 9.96 with one decimal does not
// occur.
QString padded(const QString& number, double value)
{
    return value < 10.0 ? QLocale().zeroDigit() + number : number;
}

// "18.65° N" as the locale writes numbers.
QString degreesText(const AngleParts& parts)
{
    const QString letter = letterOf(parts.direction);
    if (parts.notation == AngleNotation::DecimalDegrees) {
        //: A latitude or longitude: %1 is degrees, %2 N, S, E or W
        return tr("%1° %2").arg(fixed(parts.degrees, parts.digits), letter);
    }
    const QString degrees = fixed(parts.degrees, 0);
    if (parts.digits < -1) {
        return tr("%1° %2").arg(degrees, letter);
    }
    const QString minutes = padded(fixed(parts.minutes, 0), parts.minutes);
    if (parts.digits < 0) {
        //: Degrees and minutes, then N, S, E or W
        return tr("%1° %2′ %3").arg(degrees, minutes, letter);
    }
    const QString seconds = padded(fixed(parts.seconds, parts.digits), parts.seconds);
    //: Degrees, minutes and seconds, then N, S, E or W
    return tr("%1° %2′ %3″ %4").arg(degrees, minutes, seconds, letter);
}

Angle writtenLatitude(Angle planetocentric, const CoordinateFormat& format, const RasterInfo& info)
{
    return format.latitudesOn(info.body) == LatitudeKind::Planetographic
               ? info.crs->ellipsoid()->planetographic(planetocentric)
               : planetocentric;
}

struct PointParts {
    AngleParts latitude;
    AngleParts longitude;
};

PointParts partsOf(const GeographicPoint& point,
                   const CoordinateFormat& format,
                   const RasterInfo& info,
                   int digits)
{
    return {.latitude =
                latitudeParts(writtenLatitude(point.latitude, format, info), format.angles, digits),
            .longitude = longitudeParts(point.longitude, format.longitudesOn(info.body),
                                        format.angles, digits)};
}

// The side of a sample, or of a pixel on screen where that is larger.
double readSide(const Georeference& georeference, double screen_pixel_m)
{
    return std::max(std::min(georeference.pixelWidthMeters(), georeference.pixelHeightMeters()),
                    screen_pixel_m);
}

int digitsOf(const CoordinateFormat& format,
             const RasterInfo& info,
             const Georeference& georeference,
             double screen_pixel_m)
{
    return digitsFor(format.angles, Angle::radians(readSide(georeference, screen_pixel_m) /
                                                   info.crs->ellipsoid()->equatorial_m / 10.0));
}

int mapDecimals(const Georeference& georeference, double screen_pixel_m)
{
    const GeoTransform& transform = georeference.transform();
    const double sample = std::min(transform.pixelWidth(), transform.pixelHeight());
    const double sample_m = readSide(georeference, 0.0);
    const double share = sample_m > 0.0 ? readSide(georeference, screen_pixel_m) / sample_m : 1.0;
    return decimalsFor(sample * share, 7);
}

} // namespace

QString withPlainDirections(QString typed)
{
    for (const char direction : {'N', 'S', 'E', 'W'}) {
        const QString letter = letterOf(direction);
        if (letter != QLatin1Char(direction)) {
            typed.replace(QRegularExpression(QStringLiteral("(?<!\\p{L})%1(?!\\p{L})")
                                                 .arg(QRegularExpression::escape(letter)),
                                             QRegularExpression::CaseInsensitiveOption |
                                                 QRegularExpression::UseUnicodePropertiesOption),
                          QString(QLatin1Char(direction)));
        }
    }
    return typed;
}

PositionSystem systemOn(const CoordinateFormat& format, const RasterInfo& info)
{
    return info.crs && info.crs->ellipsoid() ? format.system : PositionSystem::Map;
}

bool hasKindsOfLatitude(const RasterInfo& info)
{
    return info.crs && info.crs->ellipsoid() && !info.crs->ellipsoid()->isSphere();
}

QString latitudeKindName(LatitudeKind kind, const RasterInfo& info)
{
    if (kind == LatitudeKind::Planetocentric) {
        return isEarth(info) ? tr("geocentric") : tr("planetocentric");
    }
    return isEarth(info) ? tr("geodetic") : tr("planetographic");
}

QString formatName(const CoordinateFormat& format, const RasterInfo& info)
{
    if (systemOn(format, info) == PositionSystem::Geographic) {
        return latitudeKindName(format.latitudesOn(info.body), info);
    }
    if (!info.crs) {
        return tr("map, no CRS");
    }
    const QString name = QString::fromStdString(info.crs->name());
    return name.isEmpty() || name == QStringLiteral("unnamed") ? tr("map") : isolated(name);
}

QString positionText(const CoordinateFormat& format,
                     const RasterInfo& info,
                     const Georeference& georeference,
                     GridPoint grid,
                     double screen_pixel_m)
{
    if (systemOn(format, info) == PositionSystem::Geographic) {
        const auto point = georeference.toGeographic(grid);
        return point ? geographicText(*point, format, info,
                                      digitsOf(format, info, georeference, screen_pixel_m))
                     : QString();
    }
    const MapPoint point = georeference.toMap(grid);
    const int decimals = mapDecimals(georeference, screen_pixel_m);
    const QString x = numberText(point.x, decimals);
    const QString y = numberText(point.y, decimals);
    if (info.crs && info.crs->kind() == CrsKind::Geographic) {
        //: Map coordinates that are degrees: %1 is x, %2 is y
        return leftToRight(tr("%1°, %2°").arg(x, y));
    }
    const QString unit = info.crs ? unitSymbol(*info.crs) : QString();
    //: Map coordinates: %1 is x, %2 is y, %3 their unit
    return leftToRight(tr("%1, %2 %3").arg(x, y, unit).trimmed());
}

QString
positionText(const CoordinateFormat& format, const Map& map, GridPoint grid, double screen_pixel_m)
{
    return positionText(format, map.info(), map.georeference(), grid, screen_pixel_m);
}

QString positionText(const CoordinateFormat& format, const Map& map, const DrawnVertex& vertex)
{
    const Georeference& georeference = map.georeference();
    const auto* point = std::get_if<GeographicPoint>(&vertex);
    const auto grid = point != nullptr
                          ? georeference.toGrid(*point)
                          : std::optional(georeference.toGrid(std::get<MapPoint>(vertex)));
    return grid ? positionText(format, map, *grid) : QString();
}

QString plainPositionText(const CoordinateFormat& format,
                          const Map& map,
                          GridPoint grid,
                          double screen_pixel_m)
{
    const RasterInfo& info = map.info();
    const Georeference& georeference = map.georeference();
    if (systemOn(format, info) == PositionSystem::Geographic) {
        const auto point = georeference.toGeographic(grid);
        if (!point) {
            return {};
        }
        const PointParts parts =
            partsOf(*point, format, info, digitsOf(format, info, georeference, screen_pixel_m));
        return QStringLiteral("%1, %2").arg(QString::fromStdString(angleText(parts.latitude)),
                                            QString::fromStdString(angleText(parts.longitude)));
    }
    const MapPoint point = georeference.toMap(grid);
    const int decimals = mapDecimals(georeference, screen_pixel_m);
    return QStringLiteral("%1, %2").arg(QString::number(point.x, 'f', decimals),
                                        QString::number(point.y, 'f', decimals));
}

QString latitudeText(Angle latitude, const CoordinateFormat& format, int digits)
{
    return leftToRight(degreesText(latitudeParts(latitude, format.angles, digits)));
}

QString longitudeText(Angle longitude, const CoordinateFormat& format, const Body* body, int digits)
{
    return leftToRight(
        degreesText(longitudeParts(longitude, format.longitudesOn(body), format.angles, digits)));
}

QString geographicText(const GeographicPoint& point,
                       const CoordinateFormat& format,
                       const RasterInfo& info,
                       int digits)
{
    const PointParts parts = partsOf(point, format, info, digits);
    //: %1 is the latitude, %2 the longitude
    return leftToRight(tr("%1, %2").arg(degreesText(parts.latitude), degreesText(parts.longitude)));
}

ExtentText
extentText(const GeographicExtent& extent, const CoordinateFormat& format, const RasterInfo& info)
{
    const Angle side = std::min(extent.east - extent.west, extent.north - extent.south);
    const Angle south = writtenLatitude(extent.south, format, info);
    const Angle north = writtenLatitude(extent.north, format, info);
    const auto ends = [&](int digits) {
        const auto [low, high] = longitudeSpanParts(
            extent.west, extent.east, format.longitudesOn(info.body), format.angles, digits);
        return std::array{low, high, latitudeParts(south, format.angles, digits),
                          latitudeParts(north, format.angles, digits)};
    };
    // Without the zeros that all ends share.
    const auto full = ends(digitsFor(format.angles, side * 0.01));
    auto shown = full;
    for (int digits = full[0].digits - 1; digits >= digitsFor(format.angles, Angle::degrees(1.0));
         --digits) {
        const auto shorter = ends(digits);
        const bool is_same =
            std::equal(shorter.begin(), shorter.end(), full.begin(),
                       [](const AngleParts& a, const AngleParts& b) {
                           return a.degrees == b.degrees && a.minutes == b.minutes &&
                                  a.seconds == b.seconds && a.direction == b.direction;
                       });
        if (!is_same) {
            break;
        }
        shown = shorter;
    }
    //: A span of longitude or latitude, from %1 to %2
    const QString span = tr("%1 – %2");
    return {.longitudes = leftToRight(span.arg(degreesText(shown[0]), degreesText(shown[1]))),
            .latitudes = leftToRight(span.arg(degreesText(shown[2]), degreesText(shown[3])))};
}

QString pixelAngleText(double degrees)
{
    constexpr int kDigits = 5;
    constexpr double kNoise = 1e-6; // of a size that was written with few digits
    struct Unit {
        double per_degree;
        double least; // below it the next unit is easier to read
        QString sign;
    };
    const std::array<Unit, 3> units{Unit{1.0, 0.01, QStringLiteral("°")},
                                    {60.0, 1.0, QStringLiteral("′")},
                                    {3600.0, 0.0, QStringLiteral("″")}};
    for (const Unit& unit : units) {
        const double size = degrees * unit.per_degree;
        const double shown = QString::number(size, 'g', kDigits).toDouble();
        if (std::abs(shown - size) <= kNoise * std::abs(size) && std::abs(size) >= unit.least) {
            return leftToRight(shortNumberText(size, kDigits) + unit.sign);
        }
    }
    const Unit& unit = std::abs(degrees) < 0.1 ? units[2] : units[0];
    return leftToRight(shortNumberText(degrees * unit.per_degree, kDigits) + unit.sign);
}

QString datumText(const RasterInfo& info)
{
    // Not one that the user has named.
    if (info.reference_radius_m && info.vertical_datum.starts_with("sphere of radius ")) {
        //: A vertical datum: %1 is a radius in meters
        return tr("sphere of radius %1")
            .arg(withUnit(sampleText(*info.reference_radius_m), QStringLiteral("m")));
    }
    if (info.vertical_datum == "areoid") {
        //: The vertical datum of Mars: a surface of equal potential
        return tr("areoid");
    }
    if (info.vertical_datum == "EGM96 geoid") {
        //: The vertical datum of many maps of the Earth
        return tr("EGM96 geoid");
    }
    return QString::fromStdString(info.vertical_datum);
}

QString
heightText(const RasterInfo& info, const HeightRange& range, double height_m, HeightUnit unit)
{
    const double relief = inUnit(range.maximum_m, unit) - inUnit(range.minimum_m, unit);
    const QString value = withUnit(
        numberText(inUnit(height_m, unit), decimalsFor(relief / 100.0, 3)), unitSymbol(unit));
    //: %1 is an elevation with its unit, %2 the vertical datum
    const QString datum = datumText(info);
    return datum.isEmpty() ? value : tr("%1 (%2)").arg(value, isolated(datum));
}

} // namespace marsview
