#include "ui/globe/globe_scene.h"

#include "core/session/measurement.h"
#include "core/session/name_labels.h"
#include "ui/globe/globe_view.h"

#include <QRectF>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace marsview {

GlobeScene::GlobeScene(GlobeView& globe, QObject* parent)
    : DrawingScene(parent)
    , globe_(globe)
{
    connect(&globe, &GlobeView::sightChanged, this, &DrawingScene::sightChanged);
    connect(&globe, &GlobeView::pictureCompleted, this, &DrawingScene::pictureCompleted);
    connect(&globe, &GlobeView::sceneChanged, this, [this] {
        if (globe_.exaggeration() != exaggeration_) {
            noteScene();
        }
    });
    connect(&globe, &GlobeView::placed, this, &GlobeScene::noteScene);
    noteScene();
}

void GlobeScene::noteScene()
{
    const double before = std::exchange(exaggeration_, globe_.exaggeration());
    sight_.reset();
    if (!globe_.scene().isEmpty()) {
        range_ = globe_.scene().range();
    }
    if (before != exaggeration_) {
        Q_EMIT exaggerationChanged();
    }
    Q_EMIT mapsChanged();
}

const QWidget& GlobeScene::view() const
{
    return globe_;
}

std::shared_ptr<const Map> GlobeScene::map() const
{
    return globe_.terrain() != nullptr ? globe_.terrain()->map() : nullptr;
}

CameraPose GlobeScene::camera() const
{
    return map() ? bodyView().pose() : CameraPose(OrbitCamera{});
}

double GlobeScene::exaggeration() const
{
    return globe_.exaggeration();
}

const BodyView& GlobeScene::bodyView() const
{
    const BodyCamera& camera = globe_.camera();
    const Viewport viewport = globe_.viewport();
    if (!sight_ || !(sight_->of == camera) || sight_->view.viewport().width != viewport.width ||
        sight_->view.viewport().height != viewport.height) {
        const Ellipsoid& ellipsoid = globe_.scene().ellipsoid();
        sight_.emplace(Sight{.of = camera,
                             .view = BodyView(poseOf(camera, ellipsoid), viewport, ellipsoid,
                                              {.lowest_m = range_.minimum_m,
                                               .highest_m = range_.maximum_m,
                                               .exaggeration = exaggeration_})});
    }
    return sight_->view;
}

// The maps of a scene may have other ellipsoids: longitude and planetocentric latitude count.
std::optional<ScenePoint> GlobeScene::onTerrain(const MeasuredTerrain& terrain,
                                                GroundPosition position) const
{
    if (globe_.scene().isEmpty() || !terrain.ground().ellipsoid()) {
        return std::nullopt;
    }
    return onTerrain(terrain.ground().geographic(position));
}

std::optional<ScenePoint> GlobeScene::onTerrain(const GeographicPoint& place) const
{
    const double height_m = globe_.scene().height(place) * globe_.exaggeration();
    return std::isfinite(height_m) ? std::optional(targetOf({.target = place, .height_m = height_m},
                                                            globe_.scene().ellipsoid()))
                                   : std::nullopt;
}

std::optional<QPointF> GlobeScene::positionOf(const ScenePoint& place) const
{
    if (globe_.scene().isEmpty() || isBehindHorizon(place)) {
        return std::nullopt;
    }
    const auto pixel = project(bodyView().pose(), bodyView().viewport(), place);
    return pixel && std::isfinite(pixel->x)
               ? std::optional(QPointF(pixel->x, pixel->y) / globe_.devicePixelRatioF())
               : std::nullopt;
}

bool GlobeScene::isHidden(const ScenePoint& place) const
{
    const BodyView& view = bodyView();
    return !isVisible(globe_.scene(), view.pose(), view.viewport(), exaggeration_, place,
                      globe_.devicePixelRatioF());
}

bool GlobeScene::isBehindHorizon(const ScenePoint& place) const
{
    return bodyView().isBehindHorizon(place);
}

bool GlobeScene::isOutOfSight(const std::optional<ScenePoint>& from,
                              const std::optional<ScenePoint>& to,
                              double length_m) const
{
    return from && to ? bodyView().isOutOfSight(*from, *to, length_m) : !from && !to;
}

DotSight GlobeScene::dotSight(const QRectF& area) const
{
    return map() ? DotSight(bodyView().pose(), bodyView().viewport(), globe_.devicePixelRatioF(),
                            1.0, area, bodyView().horizon())
                 : DotSight(camera(), viewport(), 1.0, 1.0, area);
}

std::optional<DrawingScene::Place>
GlobeScene::placeOf(const std::optional<BodyScenePoint>& ground) const
{
    if (!ground) {
        return std::nullopt;
    }
    const auto& map = globe_.scene().maps()[ground->index].map();
    const auto vertex = vertexAt(map->georeference(), ground->hit.grid);
    return vertex ? std::optional(Place{*vertex, map}) : std::nullopt;
}

std::optional<DrawingScene::Place> GlobeScene::placeAt(QPointF position) const
{
    return placeOf(globe_.placeAt(position));
}

std::optional<DrawingScene::Place> GlobeScene::placeRead() const
{
    return placeOf(globe_.reading());
}

bool GlobeScene::isReadByStylus() const
{
    return globe_.readingSource() == ReadingSource::Stylus;
}

void GlobeScene::setPlaceTool(Tool tool, PlaceTool* place_tool)
{
    globe_.setPlaceTool(tool, place_tool);
}

void GlobeScene::setLines(std::vector<DrapedLine> lines, LineSet set)
{
    globe_.setLines(std::move(lines), set);
}

void GlobeScene::setDots(DotSet dots, LineSet set)
{
    globe_.setDots(std::move(dots), set);
}

void GlobeScene::flyToAll(const std::vector<ScenePoint>& places)
{
    Vec3 sum{};
    for (const ScenePoint& place : places) {
        sum = sum + place;
    }
    ScenePoint middle = sum * (1.0 / static_cast<double>(places.size()));
    if (length(middle) < 0.1 * globe_.scene().ellipsoid().polar_m) {
        middle = places.front(); // all around the body
    }
    double extent_m = 0.0;
    for (const ScenePoint& place : places) {
        extent_m = std::max(extent_m, 2.0 * length(place - middle));
    }
    constexpr double kDistanceShare = 1.8; // of the extent, for all of it to be in sight
    globe_.flyTo(marsview::placeOf(middle, globe_.scene().ellipsoid()).foot,
                 kDistanceShare * extent_m);
}

// Cells of some meters, so that edges in other CRSs follow their true course as closely.
std::shared_ptr<const ScenePlan> GlobeScene::plan() const
{
    const auto shown = map();
    if (!shown || shown->info().body == nullptr) {
        return nullptr;
    }
    if (!plan_ || plan_->map != shown) {
        constexpr std::size_t kPerDegree = 10000;
        constexpr double kStep = 1.0 / kPerDegree;
        plan_ = std::make_shared<const ScenePlan>(
            ScenePlan{.map = shown,
                      .georeference = Georeference(
                          360 * kPerDegree, 180 * kPerDegree,
                          GeoTransform::fromTerms({-180.0, kStep, 0.0, 90.0, 0.0, -kStep}).value(),
                          Crs::geographic(*shown->info().body, globe_.scene().ellipsoid())),
                      .has_equator_scale = true});
    }
    return plan_;
}

std::optional<ScenePoint> GlobeScene::onTerrain(const PlanePoint& point) const
{
    const auto known = plan();
    const auto place = known ? known->georeference.toGeographic(
                                   known->georeference.sceneFrame().toGrid({point.x, point.y, 0.0}))
                             : std::nullopt;
    return place ? onTerrain(*place) : std::nullopt;
}

// Around the middle of a box, on the ground: no way is longer than in the plan, which has the scale
// of the equator.
std::function<double(const PlaneBox&)> GlobeScene::planResolution() const
{
    const BodyView& now = bodyView();
    const double highest_m =
        std::max(std::abs(range_.minimum_m), std::abs(range_.maximum_m)) * exaggeration_;
    const double above_m = marsview::placeOf(now.pose().eye, now.ellipsoid()).height_m - highest_m;
    // Navigation keeps the eye so far above the terrain.
    const double least_m = std::max(above_m, now.pose().distance_m / 50.0);
    const double point_share = globe_.devicePixelRatioF() *
                               metersPerPixel(now.pose(), now.viewport()) / now.pose().distance_m;
    return [now, known = plan(), highest_m, least_m, point_share](const PlaneBox& box) {
        constexpr double kMargin = 1.01; // for the flattening
        const ScenePoint middle{0.5 * (box.min_x + box.max_x), 0.5 * (box.min_y + box.max_y), 0.0};
        const auto place =
            known->georeference.toGeographic(known->georeference.sceneFrame().toGrid(middle));
        if (!place) {
            return std::numeric_limits<double>::infinity();
        }
        const double reach_m =
            0.5 * kMargin * std::hypot(box.max_x - box.min_x, box.max_y - box.min_y) + highest_m;
        const ScenePoint center = targetOf({.target = *place}, now.ellipsoid());
        if (now.isOutOfSight(center, reach_m)) {
            return std::numeric_limits<double>::infinity();
        }
        const double way_m = length(center - now.pose().eye) - reach_m;
        return point_share * std::max(way_m, least_m);
    };
}

void GlobeScene::flyToBox(const PlaneBox& box)
{
    constexpr int kSteps = 8;
    std::vector<ScenePoint> places;
    for (int i = 0; i <= kSteps; ++i) {
        for (int k = 0; k <= kSteps; ++k) {
            const auto place =
                onTerrain(PlanePoint{std::lerp(box.min_x, box.max_x, i / double{kSteps}),
                                     std::lerp(box.min_y, box.max_y, k / double{kSteps})});
            if (place) {
                places.push_back(*place);
            }
        }
    }
    if (!places.empty()) {
        flyToAll(places);
    }
}

} // namespace marsview
