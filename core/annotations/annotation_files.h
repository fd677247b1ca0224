// Annotations in vector files that other programs read and write.
#pragma once

#include "core/annotations/annotation.h"
#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/vector/vector_file.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace marsview {

/// How features are divided into layers.
enum class FeatureLayers {
    One,     // "annotations"
    ByShape, // "points", "lines" and "polygons", as far as there are any
};

/// A collection for each body, in longitude and latitude on it, and one in map coordinates for maps
/// without a body. The fields are name, note, color as "#ffdd40", symbol of a point, and time;
/// those that an annotation does not have are empty. Lines and borders are those of
/// DrawnGeometry::line(). Any thread.
std::vector<FeatureCollection> annotationFeatures(std::span<const Annotation> annotations,
                                                  FeatureLayers layers);

/// Where collections are written: `path`, or if there are several next to it with the name of the
/// body: "gale-mars.gpkg", "gale-moon.gpkg".
std::vector<std::filesystem::path> collectionPaths(std::span<const FeatureCollection> collections,
                                                   const std::filesystem::path& path);

/// Writes the collections there. Replaces such files when the new ones are complete. Returns and
/// refuses as writeVectorFile(). Blocks on the disk.
Result<std::vector<std::string>> writeCollections(std::span<const FeatureCollection> collections,
                                                  const std::filesystem::path& path,
                                                  JobMonitor& monitor);

/// Writes annotations in the format that the name of `path` ends in: GeoPackage (a layer for each
/// shape), GeoJSON, KML, CSV, or Shapefile. A Shapefile holds one shape: for several, the files are
/// "rims-points.shp", "rims-lines.shp", "rims-polygons.shp". Otherwise as writeCollections().
Result<std::vector<std::string>> writeAnnotations(std::span<const Annotation> annotations,
                                                  const std::filesystem::path& path,
                                                  JobMonitor& monitor);

struct ImportedAnnotations {
    std::vector<Annotation> annotations;
    std::vector<std::string> notices; // what was not taken over, one sentence each
};

/// The features of a file on the body of a map, without a CRS in the coordinates of that map.
/// Names, notes, colors, symbols and times are those of the fields called so, in any case;
/// "description" is a note too, and a feature without a name gets that of its layer. Each part of a
/// feature becomes an annotation; holes and other fields are left out, with a notice. Edges become
/// shortest lines between the file's vertices.
///
/// Invalid for features of another body (checkSameBody) and for a file with a CRS on a map without
/// one, TooLarge above 100 000 annotations, and
/// OutOfRange where a position is outside the projection of the CRS. `path` is what errors begin
/// with.
Result<ImportedAnnotations> annotationsFrom(const std::string& path,
                                            const VectorFile& file,
                                            const Georeference& map,
                                            const Body* map_body);

} // namespace marsview
