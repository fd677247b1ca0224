// The frames of reference, once and for all. Points of different frames are different types.
//
//   frame       unit      axes                                              type
//   grid        sample    column right, row down; (c, r) is a pixel centre  GridPoint
//   map         CRS unit  the raster's CRS as its geotransform writes it    MapPoint
//   geographic  angle     planetocentric latitude, east-positive longitude  GeographicPoint
//   scene       metre     x east, y north, z up; origin: dataset's centre   ScenePoint
//
// The grid differs from GDAL's pixel/line by half a pixel: GDAL counts from the outer corner of the
// first pixel, the grid from its centre. GeoTransform and Georeference do that shift; nobody else.
#pragma once

#include "core/base/angle.h"
#include "core/base/vec.h"

namespace marsview {

/// A position on the sample grid. Integer coordinates are sample centres.
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

/// A position on a body: planetocentric latitude in [-90°, 90°], east-positive longitude.
/// The longitude's range is whatever the producer says; consumers take any.
struct GeographicPoint {
    Angle longitude;
    Angle latitude;
    constexpr bool operator==(const GeographicPoint&) const = default;
};

/// A position in the scene: metres east, north and up (height × exaggeration) of the origin.
using ScenePoint = Vec3;

} // namespace marsview
