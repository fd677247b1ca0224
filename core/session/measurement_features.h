// Measurements as features, for files that other programs read.
#pragma once

#include "core/base/result.h"
#include "core/geo/crs.h"
#include "core/session/measurement.h"
#include "core/vector/feature.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace marsview {

/// A measurement with what is known of its layer.
struct NamedMeasurement {
    Measurement measurement; // with its result, if there is one
    std::string layer_name{};
    std::optional<Crs> crs{}; // of the layer's map
};

/// A collection for each ellipsoid, in longitude and latitude on its body, and one in map
/// coordinates for maps without a body. Each has a layer for each kind of measurement that occurs.
/// The fields are the name, the note, the color as "#ffdd40", the layer, the time, and the results
/// with their units in their names; they are empty without a result.
///
/// Lines and borders follow the shortest lines on the ellipsoid: consecutive positions are at most
/// half a degree of arc apart. An attitude is the point in the middle of its plane, a crater its
/// circle; without a result both are their points. Any thread.
std::vector<FeatureCollection> measurementFeatures(std::span<const NamedMeasurement> measurements);

/// "depth_m 807.6123; rim_m -1204.25": the results among those fields, in full and without those
/// that are unknown; empty without a result.
std::string resultsText(const Measurement& measurement);

/// Writes the features as GeoPackages: to `path` if there is one collection, otherwise next to it
/// with the body's name in theirs: "gale-mars.gpkg", "gale-moon.gpkg". Replaces such files when the
/// new ones are complete. Blocks on the disk. Errors as writeVectorFile().
Status writeMeasurements(std::span<const NamedMeasurement> measurements,
                         const std::filesystem::path& path);

} // namespace marsview
