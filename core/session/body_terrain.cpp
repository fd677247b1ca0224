#include "core/session/body_terrain.h"

#include "core/globe/body_camera.h"
#include "core/terrain/ray_cast.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace marsview {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// A ray is cut into pieces that are straight over the grid, to so many cells.
constexpr double kStraightCells = 1e-3;
constexpr std::size_t kRayPieces = 16;
constexpr int kDepthMax = 24;
// Pieces that lie outside the projection at both ends and in the middle are cut so often.
constexpr int kDepthOutside = 3;

constexpr int kRefinements = 40;

// Of maps on top of each other: so many covered surfaces of one a ray may pass, and where it goes
// on behind one.
constexpr int kCoveredPerMapMax = 64;
constexpr double kUnderCells = 1e-3;

// The part of a ray within an ellipsoid of revolution; nothing if it misses.
std::optional<std::pair<double, double>> within(const Ray& ray, double equatorial_m, double polar_m)
{
    if (!(equatorial_m > 0.0 && polar_m > 0.0)) {
        return std::nullopt;
    }
    const auto scaled = [&](const Vec3& v) {
        return Vec3{v.x / equatorial_m, v.y / equatorial_m, v.z / polar_m};
    };
    const Vec3 origin = scaled(ray.origin);
    const Vec3 along = scaled(ray.direction);
    const double square = dot(along, along);
    const double middle = -dot(origin, along) / square;
    const Vec3 nearest = origin + along * middle;
    const double rest = (1.0 - dot(nearest, nearest)) / square;
    if (!(rest > 0.0)) {
        return std::nullopt;
    }
    const double half = std::sqrt(rest);
    return std::pair{middle - half, middle + half};
}

} // namespace

BodyTerrain::BodyTerrain(std::shared_ptr<const Map> map,
                         std::shared_ptr<const BodyGrid> grid,
                         std::shared_ptr<const Map> shown)
    : map_(std::move(map))
    , shown_(shown ? std::move(shown) : map_)
    , grid_(std::move(grid))
    , data_(map_->georeference(), map_->heightfield())
    , surface_(shown_ == map_ ? data_ : ClosedSurface(map_->georeference(), shown_->heightfield()))
{
    const Georeference& georeference = map_->georeference();
    const GeoTransform::Terms& t = georeference.transform().terms();
    if (georeference.crs() && georeference.crs()->turn() && t[1] != 0.0 && t[2] == 0.0 &&
        t[4] == 0.0) {
        columns_per_turn_ = *georeference.crs()->turn() / std::abs(t[1]);
    }
}

// The position, in the columns of the surface, or nothing where the map ends.
std::optional<GridPoint> BodyTerrain::onSurface(GridPoint grid) const
{
    const Heightfield& heightfield = shown_->heightfield();
    const double last_column = static_cast<double>(heightfield.columns() - 1);
    const double last_row = static_cast<double>(heightfield.rows() - 1);
    if (grid.row < 0.0 && grid_->isPole(0)) {
        grid.row = 0.0;
    }
    if (grid.row > last_row && grid_->isPole(heightfield.rows() - 1)) {
        grid.row = last_row;
    }
    if (map_->georeference().wrapsAround() && grid.column < 0.0) {
        grid.column += columns_per_turn_; // into the strip behind the last column
    }
    const double columns_end = map_->georeference().wrapsAround() ? last_column + 1.0 : last_column;
    const bool is_on = grid.column >= 0.0 && grid.column <= columns_end &&
                       (grid.row >= 0.0 || grid_->poleAtFirstRow() != BodyGrid::Pole::None) &&
                       (grid.row <= last_row || grid_->poleAtLastRow() != BodyGrid::Pole::None);
    return is_on ? std::optional(grid) : std::nullopt;
}

std::optional<GridPoint> BodyTerrain::gridAt(const GeographicPoint& place) const
{
    const std::optional<GridPoint> grid = map_->georeference().toGrid(place);
    return grid ? onSurface(*grid) : std::nullopt;
}

double BodyTerrain::height(const GeographicPoint& place, Tiles tiles) const
{
    const std::optional<GridPoint> grid = gridAt(place);
    return grid ? heightOnGrid(*grid, tiles) : kNaN;
}

BodyTerrain::Place BodyTerrain::placeAt(const Ray& ray, double t, double exaggeration) const
{
    const BodyPlace place = placeOf(ray.at(t), grid_->ellipsoid());
    const std::optional<GridPoint> grid = map_->georeference().toGrid(place.foot);
    return {.t = t,
            .is_on_projection = grid.has_value(),
            .grid = grid.value_or(GridPoint{}),
            .height_m = place.height_m / exaggeration};
}

// In the turn of longitude that brings it next to the other.
GridPoint BodyTerrain::nearTo(GridPoint grid, const GridPoint& other) const
{
    if (columns_per_turn_ > 0.0) {
        grid.column +=
            columns_per_turn_ * std::round((other.column - grid.column) / columns_per_turn_);
    }
    return grid;
}

// Whether the terrain under a piece may reach up to it.
bool BodyTerrain::canMeet(const Piece& piece, double sag_m) const
{
    const MinMaxPyramid& bounds = shown_->analysis()->bounds;
    const std::size_t top = bounds.levelCount() - 1;
    const double lowest_m = std::min(piece.from.height_m, piece.to.height_m) - sag_m;
    const Heightfield& heightfield = shown_->heightfield();
    const auto last = [](std::size_t count) { return static_cast<double>(count - 1); };
    const double left = std::min(piece.from.grid.column, piece.to.grid.column) - 1.0;
    const double right = std::max(piece.from.grid.column, piece.to.grid.column) + 1.0;
    const double above = std::min(piece.from.grid.row, piece.to.grid.row) - 1.0;
    const double below = std::max(piece.from.grid.row, piece.to.grid.row) + 1.0;
    const bool is_inside = left >= 0.0 && right <= last(heightfield.columns()) && above >= 0.0 &&
                           below <= last(heightfield.rows());
    if (!is_inside) {
        const bool is_beyond_rows =
            (below < 0.0 && grid_->poleAtFirstRow() == BodyGrid::Pole::None) ||
            (above > last(heightfield.rows()) && grid_->poleAtLastRow() == BodyGrid::Pole::None);
        const bool is_beyond_columns =
            columns_per_turn_ == 0.0 && (right < 0.0 || left > last(heightfield.columns()));
        return !is_beyond_rows && !is_beyond_columns &&
               lowest_m <= static_cast<double>(bounds.bounds(top, 0, 0).maximum_m);
    }
    std::size_t level = 0;
    const auto node = [&](double index) {
        return static_cast<std::size_t>(index) / (DetailErrors::kNodeCells << level);
    };
    while (level < top && (node(right) > node(left) + 1 || node(below) > node(above) + 1)) {
        ++level;
    }
    for (std::size_t row = node(above); row <= std::min(node(below), bounds.rows(level) - 1);
         ++row) {
        for (std::size_t column = node(left);
             column <= std::min(node(right), bounds.columns(level) - 1); ++column) {
            const MinMaxPyramid::Bounds here = bounds.bounds(level, column, row);
            if (!here.isEmpty() && lowest_m <= static_cast<double>(here.maximum_m)) {
                return true;
            }
        }
    }
    return false;
}

// The height of a point of a ray over the terrain; NaN without terrain.
double BodyTerrain::clearance(const Place& place) const
{
    const std::optional<GridPoint> grid =
        place.is_on_projection ? onSurface(place.grid) : std::nullopt;
    return grid ? place.height_m - heightOnGrid(*grid) : kNaN;
}

// From a first guess to where the ray itself meets the triangle.
BodyHit
BodyTerrain::refined(double t, const Piece& piece, const Ray& ray, double exaggeration) const
{
    const double margin =
        0.01 * (piece.to.t - piece.from.t) + 5.0 * kStraightCells * grid_->stepMaxM();
    double above = std::max(0.0, t - margin);
    double under = t + margin;
    if (clearance(placeAt(ray, above, exaggeration)) > 0.0 &&
        clearance(placeAt(ray, under, exaggeration)) <= 0.0) {
        for (int i = 0; i < kRefinements; ++i) {
            const double middle = 0.5 * (above + under);
            (clearance(placeAt(ray, middle, exaggeration)) > 0.0 ? above : under) = middle;
        }
        t = under;
    }
    const Place place = placeAt(ray, t, exaggeration);
    const GridPoint grid = onSurface(place.grid).value_or(place.grid);
    const double height_m = heightOnGrid(grid);
    return {.grid = grid,
            .height_m = std::isfinite(height_m) ? height_m : place.height_m,
            .distance_m = t};
}

std::optional<BodyHit>
BodyTerrain::castPiece(const Piece& piece, const Ray& ray, double exaggeration) const
{
    const Heightfield& heightfield = shown_->heightfield();
    const double last_column = static_cast<double>(heightfield.columns() - 1);
    const double last_row = static_cast<double>(heightfield.rows() - 1);
    const GridPoint& from = piece.from.grid;
    const GridPoint& to = piece.to.grid;
    std::optional<double> first; // share of the piece
    const auto cast_shifted = [&](double shift) {
        if (std::max(from.column, to.column) + shift < 0.0 ||
            std::min(from.column, to.column) + shift > last_column) {
            return;
        }
        const auto hit = castRay(heightfield, shown_->analysis()->bounds,
                                 {.origin = {from.column + shift, from.row},
                                  .origin_height_m = piece.from.height_m,
                                  .columns_per_t = to.column - from.column,
                                  .rows_per_t = to.row - from.row,
                                  .height_per_t_m = piece.to.height_m - piece.from.height_m});
        if (hit && hit->t <= 1.0 && (!first || hit->t < *first)) {
            first = hit->t;
        }
    };
    cast_shifted(0.0);
    if (columns_per_turn_ > 0.0) {
        cast_shifted(columns_per_turn_);
        cast_shifted(-columns_per_turn_);
    }
    if (first) {
        return refined(piece.from.t + *first * (piece.to.t - piece.from.t), piece, ray,
                       exaggeration);
    }
    // In the strip across the seam, or around a pole.
    const bool is_inside = std::min(from.column, to.column) >= 0.0 &&
                           std::max(from.column, to.column) <= last_column &&
                           std::min(from.row, to.row) >= 0.0 &&
                           std::max(from.row, to.row) <= last_row;
    if (is_inside || !(clearance(placeAt(ray, piece.from.t, exaggeration)) > 0.0) ||
        !(clearance(placeAt(ray, piece.to.t, exaggeration)) <= 0.0)) {
        return std::nullopt;
    }
    double above = piece.from.t;
    double under = piece.to.t;
    for (int i = 0; i < kRefinements; ++i) {
        const double middle = 0.5 * (above + under);
        (clearance(placeAt(ray, middle, exaggeration)) > 0.0 ? above : under) = middle;
    }
    return refined(under, {.from = piece.from, .to = piece.to, .depth = 0}, ray, exaggeration);
}

std::optional<BodyHit> BodyTerrain::cast(const Ray& ray, double exaggeration) const
{
    const Ellipsoid& ellipsoid = grid_->ellipsoid();
    const HeightRange range = shown_->heightfield().range().value_or(HeightRange{});
    const double highest_m = exaggeration * range.maximum_m;
    const double lowest_m = exaggeration * range.minimum_m;
    // Surfaces at a height over an ellipsoid are not quite ellipsoids.
    const double flattening = std::abs(ellipsoid.flattening());
    const double outer_m = highest_m + flattening * std::abs(highest_m) + 1.0;
    const double inner_m = lowest_m - flattening * std::abs(lowest_m) - 1.0;
    const auto outer = within(ray, ellipsoid.equatorial_m + outer_m, ellipsoid.polar_m + outer_m);
    if (!outer || outer->second <= 0.0) {
        return std::nullopt;
    }
    const auto inner = within(ray, ellipsoid.equatorial_m + inner_m, ellipsoid.polar_m + inner_m);
    const double begin = std::max(outer->first, 0.0);
    const double end = inner && inner->second > 0.0 ? std::max(inner->first, 0.0) : outer->second;
    std::vector<Piece> pieces; // the nearest last
    std::array<Place, kRayPieces + 1> places;
    for (std::size_t i = 0; i <= kRayPieces; ++i) {
        const double share = static_cast<double>(i) / kRayPieces;
        places.at(i) = placeAt(ray, begin + (end - begin) * share, exaggeration);
    }
    for (std::size_t i = kRayPieces; i > 0; --i) {
        pieces.push_back({.from = places.at(i - 1), .to = places.at(i)});
    }
    const double straight_m = kStraightCells * grid_->stepMaxM() / exaggeration;
    while (!pieces.empty()) {
        Piece piece = pieces.back();
        pieces.pop_back();
        Place middle = placeAt(ray, 0.5 * (piece.from.t + piece.to.t), exaggeration);
        const int outside = (piece.from.is_on_projection ? 0 : 1) +
                            (piece.to.is_on_projection ? 0 : 1) + (middle.is_on_projection ? 0 : 1);
        if (outside > 0) {
            if (piece.depth < (outside == 3 ? kDepthOutside : kDepthMax)) {
                pieces.push_back({.from = middle, .to = piece.to, .depth = piece.depth + 1});
                pieces.push_back({.from = piece.from, .to = middle, .depth = piece.depth + 1});
            }
            continue;
        }
        middle.grid = nearTo(middle.grid, piece.from.grid);
        piece.to.grid = nearTo(piece.to.grid, middle.grid);
        const double bent_columns =
            std::abs(middle.grid.column - 0.5 * (piece.from.grid.column + piece.to.grid.column));
        const double bent_rows =
            std::abs(middle.grid.row - 0.5 * (piece.from.grid.row + piece.to.grid.row));
        const double bent_m =
            std::abs(middle.height_m - 0.5 * (piece.from.height_m + piece.to.height_m));
        const bool is_straight =
            bent_columns < kStraightCells && bent_rows < kStraightCells && bent_m < straight_m;
        if (!is_straight && piece.depth < kDepthMax) {
            // A bent piece still lies near its ends, if it does not turn around a pole.
            const bool is_short = bent_columns < 0.5 && bent_rows < 0.5;
            if (!is_short || canMeet(piece, 2.0 * bent_m + straight_m)) {
                pieces.push_back({.from = middle, .to = piece.to, .depth = piece.depth + 1});
                pieces.push_back({.from = piece.from, .to = middle, .depth = piece.depth + 1});
            }
            continue;
        }
        if (canMeet(piece, straight_m)) {
            if (auto hit = castPiece(piece, ray, exaggeration)) {
                return hit;
            }
        }
    }
    return std::nullopt;
}

BodyScene::BodyScene(std::vector<BodyTerrain> maps)
    : maps_(std::move(maps))
{}

std::optional<std::size_t> BodyScene::mapAt(const GeographicPoint& place) const
{
    for (std::size_t index = 0; index < maps_.size(); ++index) {
        if (std::isfinite(maps_[index].height(place))) {
            return index;
        }
    }
    return std::nullopt;
}

double BodyScene::height(const GeographicPoint& place) const
{
    const auto index = mapAt(place);
    return index ? maps_[*index].height(place) : kNaN;
}

bool BodyScene::isCovered(const BodyHit& hit, std::size_t index) const
{
    const auto place = maps_[index].map()->georeference().toGeographic(hit.grid);
    return place && std::any_of(maps_.begin(), maps_.begin() + static_cast<std::ptrdiff_t>(index),
                                [&place](const BodyTerrain& above) {
                                    return std::isfinite(above.height(*place));
                                });
}

std::optional<BodyScenePoint> BodyScene::cast(const Ray& ray, double exaggeration) const
{
    std::optional<BodyScenePoint> nearest;
    for (std::size_t index = 0; index < maps_.size(); ++index) {
        double from_m = 0.0;
        for (int i = 0; i < kCoveredPerMapMax; ++i) {
            const auto hit = maps_[index].cast({ray.at(from_m), ray.direction}, exaggeration);
            if (!hit || (nearest && from_m + hit->distance_m >= nearest->hit.distance_m)) {
                break;
            }
            const double distance_m = from_m + hit->distance_m;
            if (!isCovered(*hit, index)) {
                nearest = BodyScenePoint{.index = index, .hit = *hit};
                nearest->hit.distance_m = distance_m;
                break;
            }
            // Behind a covered surface the ray goes on a little under it.
            from_m = distance_m + kUnderCells * maps_[index].grid()->stepMaxM();
        }
    }
    return nearest;
}

HeightRange BodyScene::range() const
{
    HeightRange all = maps_.front().shown()->heightfield().range().value_or(HeightRange{});
    for (const BodyTerrain& map : maps_) {
        const HeightRange range = map.shown()->heightfield().range().value_or(all);
        all = {std::min(all.minimum_m, range.minimum_m), std::max(all.maximum_m, range.maximum_m)};
    }
    return all;
}

} // namespace marsview
