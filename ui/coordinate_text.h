// Positions and heights as people read them.
#pragma once

#include "core/geo/georeference.h"
#include "core/raster/raster_info.h"
#include "core/terrain/heightfield.h"
#include "ui/number_text.h"

#include <QString>

#include <vector>

namespace marsview {

/// In which terms a position is told.
enum class CoordinateDisplay { Map, Planetocentric, Planetographic };

/// What can be told of positions on a map, the usual one for its body first: longitude and latitude
/// where there are any, then map coordinates.
std::vector<CoordinateDisplay> coordinateDisplays(const RasterInfo& info);

/// The name of a display for a menu or label: "planetocentric", "geodetic", the CRS.
QString displayName(CoordinateDisplay display, const RasterInfo& info);

/// "18.65° N 226.20° E", or "562 345, 5 117 890 m". Resolves a tenth of a sample. Empty where the
/// position has no such coordinates.
QString coordinateText(CoordinateDisplay display,
                       const RasterInfo& info,
                       const Georeference& georeference,
                       GridPoint grid);

/// A position given by longitude and latitude, in a display other than Map, to `decimals` of a
/// degree.
QString geographicText(const GeographicPoint& point,
                       CoordinateDisplay display,
                       const RasterInfo& info,
                       int decimals);

/// "21 171 m above areoid". Resolves about a thousandth of the map's relief.
QString heightText(const RasterInfo& info,
                   const HeightRange& range,
                   double height_m,
                   HeightUnit unit = HeightUnit::Metres);

} // namespace marsview
