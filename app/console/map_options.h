// The options that select a map and override what its file states.
#pragma once

#include "core/base/result.h"
#include "core/geo/body.h"
#include "core/raster/open_raster.h"
#include "core/raster/raster_info.h"

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace marsview {

/// Filled by the parser.
struct MapOptions {
    std::string path;
    int band = 1;
    std::string crs;
    std::string body;
    std::vector<double> radii_m; // equatorial, or equatorial and polar
    std::vector<double> geotransform;
    std::string vertical_unit;
    std::optional<double> scale;
    std::optional<double> offset;
    std::string vertical_datum;
    std::optional<double> nodata;
    std::string latitude; // "planetocentric", "planetographic", or empty for the body's convention

    void addTo(CLI::App& command);
    /// All options except the map itself.
    void addOverridesTo(CLI::App& command);
    RasterOverrides overrides() const;
    RasterSpec spec() const;
    /// The overrides as they were given: for another process.
    std::vector<std::string> overrideArguments() const;
    /// Whether any option other than the map itself was given.
    bool hasOverrides() const;
    /// The kind of bare latitudes for a map of that body (null: unknown body).
    LatitudeKind latitudeKind(const Body* of_body) const;
};

/// The raster that the options name, with their overrides. Shows progress where that takes long.
Result<OpenRaster> openRaster(const MapOptions& options);

/// The notices about the map; suggestions name the options that follow them.
std::vector<std::string> noticesWithOptions(const RasterInfo& info);

/// Prints the notices about the map to stderr; call it after the result has been printed. After an
/// error only the error is printed.
void printNotices(const RasterInfo& info);

} // namespace marsview
