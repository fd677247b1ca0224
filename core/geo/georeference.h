// Where a raster lies: grid ↔ map ↔ geographic ↔ scene.
#pragma once

#include "core/geo/crs.h"
#include "core/geo/frames.h"
#include "core/geo/geotransform.h"
#include "core/geo/scene_frame.h"

#include <cstddef>
#include <optional>

namespace marsview {

/// The placement of a raster of columns × rows samples. Immutable; any thread, except that
/// geographic conversions block each other (see Crs).
class Georeference {
public:
    /// Without a CRS map coordinates are meters, and there are no geographic coordinates.
    Georeference(std::size_t columns,
                 std::size_t rows,
                 const GeoTransform& transform,
                 std::optional<Crs> crs);

    std::size_t columns() const noexcept { return columns_; }
    std::size_t rows() const noexcept { return rows_; }
    const GeoTransform& transform() const noexcept { return transform_; }
    const std::optional<Crs>& crs() const noexcept { return crs_; }
    /// Null without a CRS, or if its body is unknown.
    const Body* body() const noexcept { return crs_ ? crs_->body() : nullptr; }

    MapPoint toMap(GridPoint grid) const noexcept { return transform_.toMap(grid); }
    /// Coordinates within rounding (1e-9 sample) of a whole number are snapped to it, so that the
    /// position of a sample is neither outside the grid nor in a void next to it.
    GridPoint toGrid(MapPoint map) const noexcept;

    /// If longitude is periodic along x (geographic systems, cylindrical projections), it continues
    /// without a jump across the raster and beyond its edges: a global map runs from 0° to 360° or
    /// from -180° to 180°, as its CRS defines it. Otherwise it lies in [-180°, 180°]. Empty if the
    /// position is outside the projection or the body is unknown.
    std::optional<GeographicPoint> toGeographic(GridPoint grid) const;
    /// Longitude is taken in the turn that puts the position on the raster, or else nearest to its
    /// center.
    std::optional<GridPoint> toGrid(GeographicPoint geographic) const;
    /// The place of `grid`, a position on the grid of `other`, which is in the same CRS.
    GridPoint toGrid(GridPoint grid, const Georeference& other) const;

    /// True if the columns go once around the body, so that the first column is the eastern
    /// neighbor of the last.
    bool wrapsAround() const noexcept { return wraps_around_; }

    const SceneFrame& sceneFrame() const noexcept { return scene_frame_; }
    /// Length in meters of one step along a row and along a column at the raster's center.
    double pixelWidthMeters() const noexcept;
    double pixelHeightMeters() const noexcept;

private:
    std::size_t columns_;
    std::size_t rows_;
    GeoTransform transform_;
    std::optional<Crs> crs_;
    bool wraps_around_ = false;
    Angle center_longitude_; // of the origin of scene_frame_, if the CRS has a turn
    SceneFrame scene_frame_;
};

} // namespace marsview
