#include "ui/coordinate_text.h"

#include <QCoreApplication>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace marsview {
namespace {

QString tr(const char* text)
{
    return QCoreApplication::translate("CoordinateText", text);
}

bool isEarth(const RasterInfo& info)
{
    return info.body != nullptr && info.body->name == "Earth";
}

QString unitSymbol(const Crs& crs)
{
    if (crs.kind() == CrsKind::Geographic) {
        return QStringLiteral("°");
    }
    if (crs.unit() == 1.0) {
        return QStringLiteral("m");
    }
    return QString::fromStdString(crs.unitName());
}

} // namespace

std::vector<CoordinateDisplay> coordinateDisplays(const RasterInfo& info)
{
    std::vector<CoordinateDisplay> displays;
    if (info.crs && info.crs->ellipsoid()) {
        displays = {CoordinateDisplay::Planetocentric, CoordinateDisplay::Planetographic};
        if (info.body != nullptr && info.body->latitude == LatitudeKind::Planetographic) {
            std::swap(displays[0], displays[1]);
        }
        if (info.crs->ellipsoid()->isSphere()) {
            displays.pop_back(); // the two are the same
        }
    }
    displays.push_back(CoordinateDisplay::Map);
    return displays;
}

QString displayName(CoordinateDisplay display, const RasterInfo& info)
{
    switch (display) {
    case CoordinateDisplay::Planetocentric:
        return isEarth(info) ? tr("geocentric") : tr("planetocentric");
    case CoordinateDisplay::Planetographic:
        return isEarth(info) ? tr("geodetic") : tr("planetographic");
    case CoordinateDisplay::Map:
        break;
    }
    if (!info.crs) {
        return tr("map, no CRS");
    }
    const QString name = QString::fromStdString(info.crs->name());
    return name.isEmpty() || name == QStringLiteral("unnamed") ? tr("map") : name;
}

QString coordinateText(CoordinateDisplay display,
                       const RasterInfo& info,
                       const Georeference& georeference,
                       GridPoint grid)
{
    const GeoTransform& transform = georeference.transform();
    const double pixel = std::min(transform.pixelWidth(), transform.pixelHeight());
    if (display == CoordinateDisplay::Map) {
        const MapPoint map = georeference.toMap(grid);
        const int decimals = decimalsFor(pixel, 7);
        const QString unit = info.crs ? unitSymbol(*info.crs) : QString();
        //: Map coordinates: %1 is x, %2 is y, %3 their unit
        return tr("%1, %2 %3")
            .arg(numberText(map.x, decimals), numberText(map.y, decimals), unit)
            .trimmed();
    }
    const auto point = georeference.toGeographic(grid);
    if (!point || !info.crs->ellipsoid()) {
        return {};
    }
    const double pixel_m =
        std::min(georeference.pixelWidthMetres(), georeference.pixelHeightMetres());
    const double pixel_degrees =
        pixel_m / info.crs->ellipsoid()->equatorial_m * (180.0 / std::numbers::pi);
    return geographicText(*point, display, info, decimalsFor(pixel_degrees, 7));
}

QString geographicText(const GeographicPoint& point,
                       CoordinateDisplay display,
                       const RasterInfo& info,
                       int decimals)
{
    const Ellipsoid& ellipsoid = *info.crs->ellipsoid();
    const Angle latitude = display == CoordinateDisplay::Planetographic
                               ? ellipsoid.planetographic(point.latitude)
                               : point.latitude;
    const LongitudeRange range =
        info.body != nullptr ? info.body->longitude : LongitudeRange::From180WestTo180East;
    const double east = wrapLongitude(point.longitude, range).degrees();
    const double north = latitude.degrees();
    //: Latitude; %1 is degrees
    const QString north_text = north < 0.0 ? tr("%1° S") : tr("%1° N");
    //: Longitude; %1 is degrees
    const QString east_text = east < 0.0 ? tr("%1° W") : tr("%1° E");
    //: %1 is the latitude, %2 the longitude
    return tr("%1 %2").arg(north_text.arg(numberText(std::abs(north), decimals)),
                           east_text.arg(numberText(std::abs(east), decimals)));
}

QString
heightText(const RasterInfo& info, const HeightRange& range, double height_m, HeightUnit unit)
{
    const double relief = inUnit(range.maximum_m, unit) - inUnit(range.minimum_m, unit);
    const QString value = numberText(inUnit(height_m, unit), decimalsFor(relief / 100.0, 3));
    if (info.vertical_datum.empty()) {
        //: A height and its unit
        return tr("%1 %2").arg(value, unitSymbol(unit));
    }
    //: %1 is a height, %2 its unit, %3 what it is counted from
    return tr("%1 %2 above %3")
        .arg(value, unitSymbol(unit), QString::fromStdString(info.vertical_datum));
}

} // namespace marsview
