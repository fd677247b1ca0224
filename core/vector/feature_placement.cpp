#include "core/vector/feature_placement.h"

#include <cmath>
#include <utility>

namespace marsview {
namespace {

constexpr int kHalvingsMax = 8; // of an edge
constexpr double kLongEdgeSamples = 4.0;
constexpr double kDeviationSamples = 0.5;

double distanceBetween(const PlanePoint& a, const PlanePoint& b)
{
    return std::hypot(b.x - a.x, b.y - a.y);
}

} // namespace

FeaturePlacement::FeaturePlacement(std::optional<Crs> crs, const Georeference& map)
    : crs_(std::move(crs))
    , map_(map)
    , is_same_crs_(!crs_ || !map.crs() || crs_->wkt() == map.crs()->wkt())
{
    if (map_.crs() && map_.crs()->turn()) {
        const MapPoint origin = map_.toMap(GridPoint{0.0, 0.0});
        const PlanePoint here = scenePlace(map_.toGrid(origin));
        const PlanePoint there =
            scenePlace(map_.toGrid(MapPoint{origin.x + *map_.crs()->turn(), origin.y}));
        turn_ = PlanePoint{there.x - here.x, there.y - here.y};
    }
}

PlanePoint FeaturePlacement::scenePlace(const GridPoint& grid) const
{
    const ScenePoint scene = map_.sceneFrame().toScene(grid, 0.0);
    return {scene.x, scene.y};
}

std::optional<PlanePoint> FeaturePlacement::place(const MapPoint& point) const
{
    std::optional<GridPoint> grid;
    if (is_same_crs_ && !turn_) {
        grid = map_.toGrid(point);
    } else if (const Crs* crs = crs_ ? &*crs_ : map_.crs() ? &*map_.crs() : nullptr) {
        const auto geographic = crs->toGeographic(point);
        grid = geographic ? map_.toGrid(*geographic) : std::nullopt;
    }
    if (!grid || !std::isfinite(grid->column) || !std::isfinite(grid->row)) {
        return std::nullopt;
    }
    return scenePlace(*grid);
}

void FeaturePlacement::add(std::uint32_t id,
                           FeatureShape shape,
                           const std::vector<FeaturePart>& parts,
                           PlaneFeatures& features) const
{
    for (const FeaturePart& part : parts) {
        if (shape != FeatureShape::Point) {
            addPath(id, shape == FeatureShape::Line ? PlaneShape::Line : PlaneShape::Ring, part,
                    features);
            continue;
        }
        for (const MapPoint& point : part.points) {
            if (const auto there = place(point)) {
                features.addDot(id, *there);
            }
        }
    }
}

void FeaturePlacement::Path::add(const PlanePoint& point, bool is_for_course)
{
    points.push_back(point);
    is_course.push_back(is_for_course);
}

// The vertices after `from` up to `to`.
void FeaturePlacement::addBetween(const MapPoint& from,
                                  const MapPoint& to,
                                  const PlanePoint& from_place,
                                  const PlanePoint& to_place,
                                  int depth,
                                  Path& path) const
{
    const double sample_m = map_.sceneFrame().meanCellSideM();
    if (!is_same_crs_ && depth < kHalvingsMax &&
        distanceBetween(from_place, to_place) > kLongEdgeSamples * sample_m) {
        const MapPoint middle{0.5 * (from.x + to.x), 0.5 * (from.y + to.y)};
        const auto middle_place = place(middle);
        const PlanePoint straight{0.5 * (from_place.x + to_place.x),
                                  0.5 * (from_place.y + to_place.y)};
        // Edges that are symmetric about the middle may bend without moving it.
        constexpr int kHalvingsMin = 2;
        if (middle_place && (depth < kHalvingsMin || distanceBetween(*middle_place, straight) >
                                                         kDeviationSamples * sample_m)) {
            addBetween(from, middle, from_place, *middle_place, depth + 1, path);
            path.is_course.back() = true;
            addBetween(middle, to, *middle_place, to_place, depth + 1, path);
            return;
        }
    }
    path.add(to_place, false);
}

void FeaturePlacement::addPath(std::uint32_t id,
                               PlaneShape shape,
                               const FeaturePart& part,
                               PlaneFeatures& features) const
{
    Path path;
    bool is_whole = true;
    std::vector<Path> paths;
    const auto end_path = [&] {
        if (path.points.size() > 1) {
            paths.push_back(std::move(path));
        }
        path = {};
    };
    std::optional<PlanePoint> before;
    for (std::size_t i = 0; i < part.points.size(); ++i) {
        const auto here = place(part.points[i]);
        if (!here) {
            end_path();
            is_whole = false;
        } else if (!before) {
            path.add(*here, false);
        } else {
            const double turns =
                turn_ ? ((here->x - before->x) * turn_->x + (here->y - before->y) * turn_->y) /
                            (turn_->x * turn_->x + turn_->y * turn_->y)
                      : 0.0;
            const double jump = std::round(turns);
            if (jump == 0.0) {
                addBetween(part.points[i - 1], part.points[i], *before, *here, 0, path);
            } else { // across the seam: beyond it on both sides
                path.add({here->x - jump * turn_->x, here->y - jump * turn_->y}, false);
                end_path();
                is_whole = false;
                path.add({before->x + jump * turn_->x, before->y + jump * turn_->y}, false);
                path.add(*here, false);
            }
        }
        before = here;
    }
    end_path();
    for (const Path& one : paths) {
        features.add(id, is_whole ? shape : PlaneShape::Line, one.points, one.is_course);
    }
}

} // namespace marsview
