// Positions and elevations as people read and type them, in the format that they chose once
// (Preferences::coordinates).
#pragma once

#include "core/annotations/drawn_vertex.h"
#include "core/geo/coordinate_format.h"
#include "core/geo/extent.h"
#include "core/geo/georeference.h"
#include "core/raster/raster_info.h"
#include "core/terrain/heightfield.h"
#include "ui/text/number_text.h"

#include <QString>

namespace marsview {

class Map;

/// The system that `format` has on a map: map coordinates if the map has no geographic coordinates.
PositionSystem systemOn(const CoordinateFormat& format, const RasterInfo& info);

/// Whether planetocentric and planetographic latitudes differ there: not on a sphere, nor without a
/// body.
bool hasKindsOfLatitude(const RasterInfo& info);

/// "planetocentric", or on the Earth "geocentric".
QString latitudeKindName(LatitudeKind kind, const RasterInfo& info);

/// What positions are counted in, in a few words: the kind of latitude, or the CRS.
QString formatName(const CoordinateFormat& format, const RasterInfo& info);

/// A typed position with N, S, E and W in place of the letters that positionText() writes in the
/// user's language, such as O for east in German.
QString withPlainDirections(QString typed);

/// "18.65° N, 226.20° E", "18° 39′ 00″ N, 133° 48′ 00″ W", or "562,345, 5,117,890 m". Resolves a
/// tenth of a sample, or of a pixel on screen where that is larger (`screen_pixel_m` meters; 0 for
/// none). Empty where the position has no such coordinates.
QString positionText(const CoordinateFormat& format,
                     const RasterInfo& info,
                     const Georeference& georeference,
                     GridPoint grid,
                     double screen_pixel_m = 0.0);
QString positionText(const CoordinateFormat& format,
                     const Map& map,
                     GridPoint grid,
                     double screen_pixel_m = 0.0);

/// Of a position that was placed on a map. Empty where it has no such coordinates.
QString positionText(const CoordinateFormat& format, const Map& map, const DrawnVertex& vertex);

/// The same for the clipboard, which other programs read: with a decimal point and "-" in every
/// locale, without groups of digits, units or marks of the writing direction.
QString plainPositionText(const CoordinateFormat& format,
                          const Map& map,
                          GridPoint grid,
                          double screen_pixel_m = 0.0);

/// A position with so many digits as the format's notation has them (AngleParts::digits). The map
/// has an ellipsoid.
QString geographicText(const GeographicPoint& point,
                       const CoordinateFormat& format,
                       const RasterInfo& info,
                       int digits);

/// One coordinate: a latitude of the kind that `format` has, or an east-positive longitude, with so
/// many digits as the notation has them. `body` is null if unknown.
QString latitudeText(Angle latitude, const CoordinateFormat& format, int digits);
QString
longitudeText(Angle longitude, const CoordinateFormat& format, const Body* body, int digits);

/// "72° W – 71° W" and "18° S – 17° S".
struct ExtentText {
    QString longitudes;
    QString latitudes;
};

/// With digits for a hundredth of the shorter side, so that the noise of a projection is not shown,
/// and without zeros at the end of all of them. The map has an ellipsoid.
ExtentText
extentText(const GeographicExtent& extent, const CoordinateFormat& format, const RasterInfo& info);

/// The size of a pixel in the unit that needs the fewest digits: "0.25°", "5′", "3″".
QString pixelAngleText(double degrees);

/// "areoid", "sphere of radius 1,737,400 m"; empty if it is unknown.
QString datumText(const RasterInfo& info);

/// "21,171 m (areoid)". Resolves about a thousandth of the map's relief.
QString heightText(const RasterInfo& info,
                   const HeightRange& range,
                   double height_m,
                   HeightUnit unit = HeightUnit::Meters);

} // namespace marsview
