// Area and volume of the terrain inside a polygon.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/measure/hypsometry.h"
#include "core/measure/measured_terrain.h"

#include <optional>
#include <span>

namespace marsview {

/// What volumes are measured from.
enum class VolumeBase {
    None,
    Elevation,   // a level surface
    BorderPlane, // the best plane through the terrain along the polygon's edges
};

struct AreaOptions {
    VolumeBase base = VolumeBase::None;
    double base_m = 0.0; // of VolumeBase::Elevation
    /// Width of the classes of the hypsometry; see HypsometrySum.
    std::optional<double> hypsometry_step_m{};
};

struct TerrainArea {
    double geodesic_m2 = 0.0; // of the smaller side of the polygon, on the ellipsoid
    double perimeter_m = 0.0;
    double covered_m2 = 0.0; // the part of geodesic_m2 with terrain
    double surface_m2 = 0.0; // of the terrain
    // Of the terrain; NaN where there is none.
    double min_m = 0.0;
    double max_m = 0.0;
    double mean_m = 0.0;
    // Between the terrain and the base; positive.
    std::optional<double> volume_above_m3;
    std::optional<double> volume_below_m3;
    Hypsometry hypsometry; // of covered_m2
    /// Edges cross, so that parts enclosed in opposite directions cancel. The area, the mean and
    /// the volumes of the terrain are NaN then, and its hypsometry is empty.
    bool crosses_itself = false;
    bool is_approximate = false;
};

/// OutOfRange if a level base is farther from elevation 0 than the body's radius, or than 1e8 m on
/// a plane.
Status checkVolumeBase(const Ground& ground, const AreaOptions& options);

/// Of the closed polygon with these vertices, whose edges are geodesics. Triangles are clipped at
/// the edges, each part of terrain counts with its own area on the ellipsoid: heights are not
/// scaled by the distance to the body's center. The plane through the border is that of elevations
/// over east and north in the local frame, so it follows the curvature of the body.
///
/// Invalid for fewer than three vertices and coordinates that are none; OutOfRange as
/// checkVolumeBase(), if edges leave the map's projection, a plane reaches across a sixth of the
/// body's circumference, or classes are too many; Canceled; errors of reading.
Result<TerrainArea> measureArea(MeasuredTerrain& terrain,
                                std::span<const GroundPosition> vertices,
                                const AreaOptions& options,
                                JobMonitor& monitor);

} // namespace marsview
