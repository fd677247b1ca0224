// What the commands of `measure` share: a map and positions on it.
#pragma once

#include "app/console/map_options.h"
#include "core/measure/measured_terrain.h"
#include "core/raster/open_raster.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace marsview {

/// Filled by the parser.
struct MeasureOptions {
    MapOptions map;
    std::string points_path; // this or the next
    std::string vector_path;
    bool is_lonlat = false;
    bool is_map = false;
    bool is_json = false;

    /// Adds the map, the positions and --json to a command.
    void addTo(CLI::App& command);
    /// For the command's callback: throws a usage error unless there is one source of positions.
    void checkSource() const;
    /// How errors call the source of the positions.
    std::string positionsName() const;
};

/// A map that is measured, read directly from its file as needed, and the positions.
struct MeasureInput {
    std::unique_ptr<OpenRaster> raster;
    std::unique_ptr<MeasuredTerrain> terrain;
    /// Of a polygon in a vector file, the last position is the first one.
    std::vector<GroundPosition> positions;
    LatitudeKind latitude_kind = LatitudeKind::Planetocentric; // of positions that people read

    /// Without the repetition of the first position at the end.
    std::vector<GroundPosition> openPositions() const;
    /// Longitude and latitude in degrees of that kind; NaN on a map without a CRS.
    GroundPosition lonLat(GroundPosition position) const;
};

/// Opens the map and reads the positions. Errors begin with the file or the option.
Result<MeasureInput> openMeasureInput(const MeasureOptions& options);

/// An error of measuring with its subject in front: errors about the positions name their
/// source.
Error measureError(const MeasureOptions& options, Error error);

} // namespace marsview
