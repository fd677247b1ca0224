// Definitions of the frames of reference. Points of different frames are different types.
//
//   frame       unit      axes                                              type
//   grid        sample    column right, row down; (c, r) is a pixel center  GridPoint
//   map         CRS unit  the raster's CRS as its geotransform writes it    MapPoint
//   geographic  angle     planetocentric latitude, east-positive longitude  GeographicPoint
//   scene       meter     x east, y north, z up; origin: dataset's center   ScenePoint
//
// The grid differs from GDAL's pixel/line by half a pixel: GDAL counts from the outer corner of the
// first pixel, the grid from its center. Only GeoTransform and Georeference apply that shift.
#pragma once

#include "core/base/angle.h"
#include "core/base/vec.h"

namespace marsview {

/// A position on the sample grid. Integer coordinates are sample centers.
struct GridPoint {
    double column = 0.0;
    double row = 0.0;
    constexpr bool operator==(const GridPoint&) const = default;
};

/// A position in the raster's coordinate reference system, in its unit.
struct MapPoint {
    double x = 0.0;
    double y = 0.0;
    constexpr bool operator==(const MapPoint&) const = default;
};

/// A position on a body: planetocentric latitude in [-90°, 90°], east-positive longitude. The
/// producer determines the longitude's range; consumers must accept any.
struct GeographicPoint {
    Angle longitude;
    Angle latitude;
    constexpr bool operator==(const GeographicPoint&) const = default;
};

/// A position in the scene: meters east, north and up (height × exaggeration) of the origin.
using ScenePoint = Vec3;

} // namespace marsview
