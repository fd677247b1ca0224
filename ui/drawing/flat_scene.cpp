#include "ui/drawing/flat_scene.h"

#include "core/session/measurement.h"
#include "core/view/frustum.h"

#include <QRectF>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace marsview {

FlatScene::FlatScene(TerrainView& view)
    : view_(view)
{
    connect(&view, &TerrainView::sightChanged, this, &DrawingScene::sightChanged);
    connect(&view, &TerrainView::exaggerationChanged, this, &DrawingScene::exaggerationChanged);
    connect(&view, &TerrainView::layersChanged, this, &DrawingScene::mapsChanged);
    connect(&view, &TerrainView::pictureCompleted, this, &DrawingScene::pictureCompleted);
}

std::optional<ScenePoint> FlatScene::onTerrain(const MeasuredTerrain& terrain,
                                               GroundPosition position) const
{
    const auto grid = terrain.toGrid(position);
    if (!grid) {
        return std::nullopt;
    }
    ScenePoint point = terrain.georeference().sceneFrame().toScene(*grid, 0.0);
    point.z = view_.ground().height(point.x, point.y) * view_.exaggeration();
    return std::isfinite(point.z) ? std::optional(point) : std::nullopt;
}

bool FlatScene::isHidden(const ScenePoint& place) const
{
    // Terrain in front of it, if any, is nearer by more than the picture's error.
    const ScenePoint eye = eyeOf(view_.camera());
    const double way_m = length(place - eye);
    const auto seen = view_.ground().cast(Ray{.origin = eye, .direction = normalized(place - eye)},
                                          view_.exaggeration());
    return seen && seen->distance_m < 0.99 * way_m;
}

// Both ends on the same side of the picture.
bool FlatScene::isOutOfSight(const std::optional<ScenePoint>& from,
                             const std::optional<ScenePoint>& to,
                             double /*length_m*/) const
{
    const auto a = from ? positionOf(*from) : std::nullopt;
    const auto b = to ? positionOf(*to) : std::nullopt;
    if (!a || !b) {
        return !a && !b;
    }
    const QRectF sight(view_.rect());
    return (a->x() < sight.left() && b->x() < sight.left()) ||
           (a->x() > sight.right() && b->x() > sight.right()) ||
           (a->y() < sight.top() && b->y() < sight.top()) ||
           (a->y() > sight.bottom() && b->y() > sight.bottom());
}

DotSight FlatScene::dotSight(const QRectF& area) const
{
    return {view_.camera(), view_.viewport(), view_.devicePixelRatioF(), view_.exaggeration(),
            area};
}

std::optional<DrawingScene::Place> FlatScene::placeAt(QPointF position) const
{
    const auto hit = view_.surfaceAt(position);
    return hit ? placeOf(*hit, position) : std::nullopt;
}

std::optional<DrawingScene::Place> FlatScene::placeRead() const
{
    const auto hit = view_.reading();
    if (!hit || !view_.map()) {
        return std::nullopt;
    }
    ScenePoint point = view_.map()->georeference().sceneFrame().toScene(hit->grid, 0.0);
    point.z = view_.ground().height(point.x, point.y) * view_.exaggeration();
    return placeOf(*hit, std::isfinite(point.z) ? positionOf(point) : std::nullopt);
}

// `hit` is on the topmost map's grid, which lower maps may reach beyond.
std::optional<DrawingScene::Place> FlatScene::placeOf(const RayHit& hit,
                                                      const std::optional<QPointF>& position) const
{
    const auto vertex =
        view_.map() ? vertexAt(view_.map()->georeference(), hit.grid) : std::nullopt;
    if (!vertex) {
        return std::nullopt;
    }
    const auto ground = position ? view_.placeUnder(*position) : std::nullopt;
    return Place{*vertex, ground ? view_.ground().maps()[ground->index].map : view_.map()};
}

bool FlatScene::isReadByStylus() const
{
    return view_.readingSource() == ReadingSource::Stylus;
}

void FlatScene::setPlaceTool(Tool tool, PlaceTool* place_tool)
{
    view_.setPlaceTool(tool, place_tool);
}

void FlatScene::setLines(std::vector<DrapedLine> lines, LineSet set)
{
    view_.setLines(std::move(lines), set);
}

void FlatScene::setDots(DotSet dots, LineSet set)
{
    view_.setDots(std::move(dots), set);
}

void FlatScene::flyToAll(const std::vector<ScenePoint>& places)
{
    ScenePoint low = places.front();
    ScenePoint high = low;
    for (const ScenePoint& place : places) {
        low = {std::min(low.x, place.x), std::min(low.y, place.y), place.z};
        high = {std::max(high.x, place.x), std::max(high.y, place.y), place.z};
    }
    OrbitCamera camera = view_.cameraGoal();
    camera.target = {0.5 * (low.x + high.x), 0.5 * (low.y + high.y), 0.5 * (low.z + high.z)};
    const double extent_m = std::hypot(high.x - low.x, high.y - low.y);
    if (extent_m > 0.0) {
        constexpr double kDistanceShare = 1.8; // of the extent, for all of it to be in sight
        camera.distance_m = kDistanceShare * extent_m;
    }
    view_.flyTo(camera);
}

std::shared_ptr<const ScenePlan> FlatScene::plan() const
{
    const std::shared_ptr<const Map>& map = view_.map();
    if (!map) {
        return nullptr;
    }
    if (!plan_ || plan_->map != map) {
        plan_ = std::make_shared<const ScenePlan>(
            ScenePlan{.map = map, .georeference = map->georeference(), .has_equator_scale = false});
    }
    return plan_;
}

std::optional<ScenePoint> FlatScene::onTerrain(const PlanePoint& point) const
{
    const double z = view_.ground().height(point.x, point.y) * view_.exaggeration();
    return std::isfinite(z) ? std::optional(ScenePoint{point.x, point.y, z}) : std::nullopt;
}

std::function<double(const PlaneBox&)> FlatScene::planResolution() const
{
    const OrbitCamera& camera = view_.camera();
    const double point_share =
        view_.devicePixelRatioF() * metersPerPixel(camera, view_.viewport()) / camera.distance_m;
    return [frustum = Frustum(camera, view_.viewport()), eye = eyeOf(camera),
            terrain = view_.ground().box(view_.exaggeration()), point_share](const PlaneBox& box) {
        const SceneBox around{.minimum = {box.min_x, box.min_y, terrain.minimum.z},
                              .maximum = {box.max_x, box.max_y, terrain.maximum.z}};
        if (frustum.isOutside(around)) {
            return std::numeric_limits<double>::infinity();
        }
        const double above_m = std::max(0.0, eye.z - terrain.maximum.z);
        const double way_m = std::hypot(box.distance({eye.x, eye.y}), above_m);
        return std::max(point_share * way_m, 1e-6);
    };
}

void FlatScene::flyToBox(const PlaneBox& box)
{
    constexpr double kDistanceShare = 1.6; // of the extent, for all of it to be in sight
    const PlanePoint middle{0.5 * (box.min_x + box.max_x), 0.5 * (box.min_y + box.max_y)};
    OrbitCamera camera = view_.cameraGoal();
    camera.target = onTerrain(middle).value_or(ScenePoint{middle.x, middle.y, 0.0});
    const double extent_m = std::max(box.max_x - box.min_x, box.max_y - box.min_y);
    if (extent_m > 0.0) {
        camera.distance_m = kDistanceShare * extent_m;
    }
    view_.flyTo(camera);
}

} // namespace marsview
