// Vector files: GeoPackage, GeoJSON, KML, Shapefile and CSV, through OGR.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/vector/feature.h"

#include <string>
#include <vector>

namespace marsview {

struct VectorFile {
    FeatureCollection content;
    std::string format;               // OGR's short name, "GPKG"
    std::vector<std::string> notices; // what could not be kept, one sentence each
};

/// Reads all features of a file on disk; the format follows from the content. Curves become
/// polylines, elevations of points are left out, dates become text. In a CSV file the coordinates
/// are in columns named lon and lat, longitude and latitude, or x and y, or as WKT. KML is on the
/// Earth unless it has the hint "target=mars" or "target=moon".
///
/// NotFound, Unsupported and Unreadable name the path and say what to do; Unsupported too if layers
/// are in different CRSs; TooLarge above 50 million coordinates; Canceled when `monitor` is.
/// Blocks on the disk: not for the GUI thread.
Result<VectorFile> readVectorFile(const std::string& path, JobMonitor& monitor);

/// Whether a file is to be read with readVectorFile() rather than as a map: by the ending of its
/// name (.geojson, .kml, .shp, .gpkg), and for a GeoPackage, which may hold rasters, by whether it
/// has a layer of features. Blocks on the disk for some milliseconds.
bool isVectorFile(const std::string& path);

/// Writes to a new file, or replaces one when it is complete. The format follows from the name:
/// .gpkg, .geojson, .kml, .shp or .csv. GeoPackage, Shapefile and CSV keep the CRS; GeoJSON and KML
/// are written in longitude and latitude on the same body: planetocentric, on the Earth
/// planetographic. Returns notices as VectorFile has them.
///
/// Unsupported, with a format that can do it, where the format cannot hold the content: several
/// layers or kinds of geometry in a Shapefile, several layers in CSV or GeoJSON, bodies other than
/// the Earth, Mars and the Moon in KML, and no CRS in GeoJSON and KML.
Result<std::vector<std::string>>
writeVectorFile(const std::string& path, const FeatureCollection& content, JobMonitor& monitor);

/// Refuses features of another body than that of the map, which `map_crs` and `map_body` describe:
/// a file of Mars on a map of the Moon. A file or a map of an unknown body is refused only if the
/// radii differ by more than 1 %.
Status checkSameBody(const std::string& path,
                     const FeatureCollection& content,
                     const std::optional<Crs>& map_crs,
                     const Body* map_body);

/// For features in longitude and latitude on the Earth, as files state whose format knows no other
/// body: the longitude and latitude of the map's body that they may be meant in. Empty for other
/// features, and for a map of the Earth or an unknown body.
std::optional<Crs> likelyCrs(const FeatureCollection& content, const Body* map_body);

} // namespace marsview
