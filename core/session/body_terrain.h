// The terrain of a map on its body: heights by place, and what a ray meets first.
#pragma once

#include "core/body/body_grid.h"
#include "core/measure/closed_surface.h"
#include "core/session/map.h"
#include "core/view/camera.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace marsview {

/// A point of the terrain that a ray meets.
struct BodyHit {
    GridPoint grid; // of the map; also between its last column and one more, or a row and a pole
    double height_m = 0.0;   // of the terrain, not exaggerated
    double distance_m = 0.0; // along the ray
};

/// A map with its grid on the body. Longitude is periodic, and a map that closes around the body
/// has terrain in the strip between its last and first column, and triangles close it between its
/// outermost row and a pole (ClosedSurface). Immutable; copies share; any thread.
class BodyTerrain {
public:
    /// `shown` is the map with its edges blended into the maps below it (core/feather), if they
    /// are: the terrain is its surface. It has the same grid.
    BodyTerrain(std::shared_ptr<const Map> map,
                std::shared_ptr<const BodyGrid> grid,
                std::shared_ptr<const Map> shown = nullptr);

    /// As it was opened.
    const std::shared_ptr<const Map>& map() const noexcept { return map_; }
    /// Whose surface is drawn and touched: map(), unless its edges are blended.
    const std::shared_ptr<const Map>& shown() const noexcept { return shown_; }
    const std::shared_ptr<const BodyGrid>& grid() const noexcept { return grid_; }

    /// Where a place is on the map's grid; nothing where the map has no surface, voids apart. Next
    /// to a pole, rows may lie beyond the outermost ones.
    std::optional<GridPoint> gridAt(const GeographicPoint& place) const;
    using Tiles = ClosedSurface::Tiles;
    /// The height of the terrain in meters; NaN where the map has no surface.
    double height(const GeographicPoint& place, Tiles tiles = Tiles::Now) const;
    /// The same at a position that gridAt() found.
    double heightOnGrid(const GridPoint& grid, Tiles tiles = Tiles::Now) const
    {
        return surface_.height(grid, tiles);
    }
    /// The elevation there in the data, without blending.
    double elevationOnGrid(const GridPoint& grid, Tiles tiles = Tiles::Now) const
    {
        return data_.height(grid, tiles);
    }
    /// Whether elevationOnGrid() is of full resolution.
    bool isExact(const GridPoint& grid) const { return data_.isExact(grid); }

    /// The first point of the terrain along a ray of the body-fixed frame that begins above it, at
    /// full resolution; for a tiled map, at the finest resident level. To a thousandth of a cell.
    std::optional<BodyHit> cast(const Ray& ray, double exaggeration) const;

private:
    // A point of a ray over the grid.
    struct Place {
        double t = 0.0;
        bool is_on_projection = false;
        GridPoint grid{};
        double height_m = 0.0; // not exaggerated
    };
    struct Piece {
        Place from;
        Place to;
        int depth = 0;
    };

    Place placeAt(const Ray& ray, double t, double exaggeration) const;
    GridPoint nearTo(GridPoint grid, const GridPoint& other) const;
    bool canMeet(const Piece& piece, double sag_m) const;
    std::optional<BodyHit> castPiece(const Piece& piece, const Ray& ray, double exaggeration) const;
    BodyHit refined(double t, const Piece& piece, const Ray& ray, double exaggeration) const;
    double clearance(const Place& place) const;
    std::optional<GridPoint> onSurface(GridPoint grid) const;

    std::shared_ptr<const Map> map_;
    std::shared_ptr<const Map> shown_;
    std::shared_ptr<const BodyGrid> grid_;
    ClosedSurface data_;            // of map_
    ClosedSurface surface_;         // of shown_
    double columns_per_turn_ = 0.0; // 0 where longitude is not periodic along the columns
};

/// A point of the terrain of several maps.
struct BodyScenePoint {
    std::size_t index = 0; // of the map, counted from the top
    BodyHit hit;           // on that map's grid
};

/// Maps on one body, on top of each other whatever their projections: at each place the terrain is
/// that of the uppermost map with a surface there. Immutable; copies share; any thread.
class BodyScene {
public:
    BodyScene() = default;
    /// The uppermost first; all on the same ellipsoid.
    explicit BodyScene(std::vector<BodyTerrain> maps);

    bool isEmpty() const noexcept { return maps_.empty(); }
    const std::vector<BodyTerrain>& maps() const noexcept { return maps_; }
    /// Not of an empty scene.
    const Ellipsoid& ellipsoid() const { return maps_.front().grid()->ellipsoid(); }

    /// The map with that surface; empty without terrain there.
    std::optional<std::size_t> mapAt(const GeographicPoint& place) const;
    /// NaN without terrain.
    double height(const GeographicPoint& place) const;
    /// As BodyTerrain::cast().
    std::optional<BodyScenePoint> cast(const Ray& ray, double exaggeration) const;
    /// The lowest and the highest elevation of all maps.
    HeightRange range() const;

private:
    bool isCovered(const BodyHit& hit, std::size_t index) const;

    std::vector<BodyTerrain> maps_;
};

} // namespace marsview
