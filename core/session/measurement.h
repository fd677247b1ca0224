// Measurements as the document holds them: geometry, the layer they were made on, and results.
#pragma once

#include "core/annotations/drawn_vertex.h"
#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/geo/frames.h"
#include "core/measure/attitude.h"
#include "core/measure/crater.h"
#include "core/measure/line_measures.h"
#include "core/measure/measured_digits.h"
#include "core/measure/measured_terrain.h"
#include "core/measure/terrain_area.h"
#include "core/measure/terrain_slope.h"
#include "core/session/session.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace marsview {

enum class MeasurementKind { Distance, Area, Profile, Attitude, Crater, Slope };

/// A position of a measurement.
using MeasuredVertex = DrawnVertex;

/// The result of one of the functions of core/measure.
using MeasuredValues =
    std::variant<Distance, TerrainArea, Profile, Attitude, Crater, std::vector<TerrainSlope>>;

/// Results, and the map that they were computed from.
struct MeasurementResult {
    RasterSpec map; // with its overrides
    Result<MeasuredValues> values;
    bool is_approximate = false;        // of a coarser level or a preview
    std::vector<double> elevations_m{}; // of the vertices; NaN where there is no terrain
    MeasuredResolution resolution{};    // of the map
};

/// A value; copies share the result. Whoever holds it may be any thread.
struct Measurement {
    MeasurementKind kind = MeasurementKind::Distance;
    std::string name{};
    std::vector<MeasuredVertex> vertices{};
    LayerId layer = LayerId::None; // on which it was made
    std::chrono::system_clock::time_point time{};
    std::string note{};                        // by the user
    std::optional<Rgb8> color{};               // empty: the usual one
    AreaOptions area{};                        // of Area
    std::optional<double> step_m{};            // of Profile
    std::optional<double> baseline_m{};        // of Slope
    std::optional<double> elevation_error_m{}; // of Attitude
    /// Null before the first measurement.
    std::shared_ptr<const MeasurementResult> result{};
};

/// How much is read for a result.
enum class MeasureDetail {
    Quick, // a few megabytes: approximate where the measurement spans many samples
    Full,  // every sample that counts
};

/// The terrain of a map at a level of detail. Approximate for previews and for levels above 0.
MeasuredTerrain measuredTerrain(const Map& map, std::size_t level = 0);

/// The vertex at a position on the grid of a map. Empty outside its projection.
std::optional<MeasuredVertex> vertexAt(const Georeference& georeference, GridPoint grid);

/// Computes the results of `measurement` on `map`, which is the map of its layer. A failure is part
/// of the result, except Canceled, which returns null. Reads samples: not for the GUI thread.
std::shared_ptr<const MeasurementResult>
measured(const Measurement& measurement, const Map& map, MeasureDetail detail, JobMonitor& monitor);

/// Whether the result is that of `map` as it is now: the same file with the same overrides, and
/// exact unless the map itself is a preview. Otherwise measure again.
bool isCurrent(const Measurement& measurement, const Map& map);

} // namespace marsview
