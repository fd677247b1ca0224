// Coordinate reference systems of rasters, and the conversion between map and geographic
// coordinates.
//
// Only this class handles three things that PROJ and OGR leave to the caller:
//  - Returned latitudes are planetocentric. A geographic CRS uses planetographic latitudes unless
//    it has a spherical coordinate system or "Ocentric" in its name; a map projection's equations
//    yield planetographic latitude on its ellipsoid. PROJ converts between such systems without
//    distinguishing the two kinds, so it is used only for the projection itself.
//  - Returned longitudes are east-positive from the body's reference meridian: west-positive axes
//    (IAU_2015 "Ographic"), other prime meridians and other angular units are converted.
//  - Axis order is x = east-like, y = north-like, whatever the authority's order.
#pragma once

#include "core/base/result.h"
#include "core/geo/body.h"
#include "core/geo/frames.h"
#include "core/geo/vertical.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

class OGRSpatialReference;

namespace marsview {

enum class CrsKind {
    Geographic, // map coordinates are angles
    Projected,  // map coordinates are lengths in a map projection
    Local,      // lengths, without a body
};

/// A range of longitude and latitude. West is greater than east if it crosses the antimeridian.
struct GeographicArea {
    Angle west, south, east, north;
    bool contains(GeographicPoint point) const noexcept;
};

/// An immutable coordinate reference system; copies share the state. Conversions may be called from
/// any thread. Calls for one CRS block each other, so the servo thread must not use them.
class Crs {
public:
    /// Any text that OGR accepts: "EPSG:32610", "IAU_2015:49910", a PROJ string, WKT, PROJJSON.
    /// Refuses vertical systems.
    static Result<Crs> fromText(const std::string& text);

    /// The CRS of a raster. Refuses geocentric systems and systems that PROJ cannot invert. A
    /// vertical one, which a file may have alone, is Local.
    static Result<Crs> fromSpatialReference(const OGRSpatialReference& reference);

    /// Longitude and latitude in degrees on `ellipsoid`, with the body's usual kind of latitude.
    static Crs geographic(const Body& body, const Ellipsoid& ellipsoid);

    /// The same system on another ellipsoid: for files with wrong radii.
    Result<Crs> onEllipsoid(const Ellipsoid& ellipsoid, const std::string& body_name) const;

    const std::string& name() const;
    /// WKT 2 (2019), for display and for files of this program.
    const std::string& wkt() const;
    CrsKind kind() const;
    /// Name and radii; empty for a Local system.
    const std::optional<Ellipsoid>& ellipsoid() const;
    /// The body named by the CRS, its datum or its ellipsoid, or else the body with those radii.
    const Body* body() const;
    /// The kind of latitude in this CRS; Planetographic for projected systems.
    LatitudeKind latitudeKind() const;
    /// Meters in one unit of a projected or local system; radians in one unit of a geographic one.
    double unit() const;
    /// "metre", "US survey foot", "degree", …
    const std::string& unitName() const;
    /// +1 if map x grows eastward (y northward), -1 if it grows westward (southward).
    double eastSign() const;
    double northSign() const;
    /// The length in map x of a full turn of longitude, for systems in which x is periodic:
    /// geographic ones and cylindrical projections.
    const std::optional<double>& turn() const;
    /// Where the registry says that the CRS may be used, in the latitudes of the registry
    /// (planetographic). Empty if it does not say, or for all longitudes.
    const std::optional<GeographicArea>& areaOfUse() const;
    /// The map coordinates that a projected system gives its origin: false easting and northing.
    MapPoint falseOrigin() const;
    /// The unit and the name of the vertical part of a compound system, if any.
    const std::optional<VerticalUnit>& verticalUnit() const;
    const std::string& verticalDatumName() const;
    /// The assumptions that make the system usable, one sentence each.
    const std::vector<std::string>& notices() const;

    /// Longitude in [-180°, 180°] except for geographic systems, which keep the given turn. Empty
    /// if the point is outside the projection or beyond a pole, or the system is Local.
    std::optional<GeographicPoint> toGeographic(MapPoint map) const;
    /// Inverse of toGeographic, for longitudes in any turn. Round trips are exact to rounding:
    /// 1e-12° for geographic systems, 3e-8 m for projected ones.
    std::optional<MapPoint> toMap(GeographicPoint geographic) const;

private:
    struct Impl;
    explicit Crs(std::shared_ptr<const Impl> impl);

    std::shared_ptr<const Impl> impl_;
};

} // namespace marsview
