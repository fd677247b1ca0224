// What OGR's formats can hold. Used inside core/vector.
#pragma once

#include "core/geo/crs.h"

#include <optional>
#include <string>
#include <string_view>

namespace marsview {

enum class VectorFormat { GeoPackage, GeoJson, Kml, Shapefile, Csv };

/// By the ending of the name.
std::optional<VectorFormat> vectorFormatOf(std::string_view path);

/// OGR's short name of the driver that writes the format.
const char* driverOf(VectorFormat format);

/// The system of longitude and latitude that every GIS knows for a body: EPSG:4326 on the Earth,
/// otherwise the planetocentric IAU_2015 system on a sphere. Empty if PROJ has none.
std::optional<Crs> commonGeographic(const Body& body);

/// The body of a KML file's hint ("target=mars"), or the Earth; null for "target=sky".
const Body* bodyOfKml(const std::string& path);

} // namespace marsview
