// Coordinate reference systems of rasters, and the way between map and geographic coordinates.
//
// Three things that PROJ and OGR leave to the caller are settled here and nowhere else:
//  - Latitudes leave as planetocentric ones. A geographic CRS counts them planetographically
//    unless it has a spherical coordinate system or calls itself "Ocentric"; a map projection's
//    equations yield planetographic latitude on its ellipsoid. PROJ converts between such systems
//    without telling the kinds apart, so it is only ever asked for the projection itself.
//  - Longitudes leave east-positive from the body's reference meridian: west-positive axes
//    (IAU_2015 "Ographic"), other prime meridians and other angular units are undone.
//  - Axis order is x = east-like, y = north-like whatever the authority says.
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
    Local,      // lengths on no particular body
};

/// An immutable coordinate reference system; copies share the state. Conversions may be called
/// from any thread; calls for one CRS wait for each other, so they are not for the servo thread.
class Crs {
public:
    /// Anything that OGR understands: "EPSG:32610", "IAU_2015:49910", a PROJ string, WKT, PROJJSON.
    static Result<Crs> fromText(const std::string& text);

    /// From a raster. Geocentric systems and systems that PROJ cannot invert are refused.
    static Result<Crs> fromSpatialReference(const OGRSpatialReference& reference);

    /// Longitude and latitude in degrees on `ellipsoid`, latitudes as the body counts them.
    static Crs geographic(const Body& body, const Ellipsoid& ellipsoid);

    /// The same system on another ellipsoid: for files that name the wrong radii.
    Result<Crs> onEllipsoid(const Ellipsoid& ellipsoid, const std::string& body_name) const;

    const std::string& name() const;
    /// WKT 2 (2019), for people and for files of ours.
    const std::string& wkt() const;
    CrsKind kind() const;
    /// Name and radii; a Local system has neither.
    const std::optional<Ellipsoid>& ellipsoid() const;
    /// The body named by the CRS, its datum or its ellipsoid, or else the one of those radii.
    const Body* body() const;
    /// How this CRS itself counts latitude; Planetographic for projected systems.
    LatitudeKind latitudeKind() const;
    /// Metres in one unit of a projected or local system; radians in one unit of a geographic one.
    double unit() const;
    /// "metre", "US survey foot", "degree", …
    const std::string& unitName() const;
    /// +1 where map x grows eastward (y northward), -1 where it grows westward (southward).
    double eastSign() const;
    double northSign() const;
    /// The length in map x of a full turn of longitude, for systems in which x is periodic:
    /// geographic ones and cylindrical projections.
    const std::optional<double>& turn() const;
    /// The unit and the name of the vertical part of a compound system, if there is one.
    const std::optional<VerticalUnit>& verticalUnit() const;
    const std::string& verticalDatumName() const;
    /// What had to be assumed to make the system usable, one sentence each.
    const std::vector<std::string>& notices() const;

    /// Longitude in [-180°, 180°] except for geographic systems, which keep the turn they were
    /// given. Nothing where the point is outside the projection or beyond a pole, or the system is
    /// Local.
    std::optional<GeographicPoint> toGeographic(MapPoint map) const;
    /// Inverse of toGeographic, for longitudes in any turn. Round trips are good to rounding:
    /// 1e-12° for geographic systems, 3e-8 m for projected ones.
    std::optional<MapPoint> toMap(GeographicPoint geographic) const;

private:
    struct Impl;
    explicit Crs(std::shared_ptr<const Impl> impl);

    std::shared_ptr<const Impl> impl_;
};

} // namespace marsview
