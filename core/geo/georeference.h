// Where a raster lies: grid ↔ map ↔ geographic ↔ scene.
#pragma once

#include "core/geo/crs.h"
#include "core/geo/frames.h"
#include "core/geo/geotransform.h"
#include "core/geo/scene_frame.h"

#include <cstddef>
#include <optional>

namespace marsview {

/// The placement of a raster of columns × rows samples. Immutable; any thread, except that the
/// geographic conversions wait for each other (see Crs).
class Georeference {
public:
    /// Without a CRS the map counts in metres and has no geographic coordinates.
    Georeference(std::size_t columns,
                 std::size_t rows,
                 const GeoTransform& transform,
                 std::optional<Crs> crs);

    std::size_t columns() const noexcept { return columns_; }
    std::size_t rows() const noexcept { return rows_; }
    const GeoTransform& transform() const noexcept { return transform_; }
    const std::optional<Crs>& crs() const noexcept { return crs_; }
    /// Null where there is no CRS or its body is not known.
    const Body* body() const noexcept { return crs_ ? crs_->body() : nullptr; }

    MapPoint toMap(GridPoint grid) const noexcept { return transform_.toMap(grid); }
    /// Coordinates no further from a whole number than rounding (1e-9 sample) are that number, so
    /// that the place of a sample is neither outside nor in the void beside it.
    GridPoint toGrid(MapPoint map) const noexcept;

    /// Where longitude is periodic along x (geographic systems, cylindrical projections), it runs
    /// on without a jump across the raster and beyond its edges: a global map goes from 0° to 360°
    /// or from -180° to 180°, as its CRS lays it out. Otherwise it lies in [-180°, 180°]. Nothing
    /// where the position is outside the projection or there is no body to be on.
    std::optional<GeographicPoint> toGeographic(GridPoint grid) const;
    /// The turn of longitude is chosen so that the position lies on the raster, or else nearest to
    /// its centre.
    std::optional<GridPoint> toGrid(GeographicPoint geographic) const;
    /// The place of `grid`, a position on the grid of `other`, which is in the same CRS.
    GridPoint toGrid(GridPoint grid, const Georeference& other) const;

    /// True where the columns go once around the body, so that the last column's eastern neighbour
    /// is the first.
    bool wrapsAround() const noexcept { return wraps_around_; }

    const SceneFrame& sceneFrame() const noexcept { return scene_frame_; }
    /// Length in metres of one step along a row and along a column at the raster's centre.
    double pixelWidthMetres() const noexcept;
    double pixelHeightMetres() const noexcept;

private:
    std::size_t columns_;
    std::size_t rows_;
    GeoTransform transform_;
    std::optional<Crs> crs_;
    bool wraps_around_ = false;
    Angle centre_longitude_; // of the origin of scene_frame_, where the CRS has a turn
    SceneFrame scene_frame_;
};

} // namespace marsview
