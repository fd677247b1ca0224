#include "ui/pictures/flat_pictures.h"

#include "ui/canvas/terrain_view.h"
#include "ui/overlay/compass.h"
#include "ui/overlay/contour_labels_view.h"
#include "ui/overlay/drawn_marks.h"
#include "ui/overlay/legend.h"
#include "ui/overlay/map_labels.h"
#include "ui/overlay/map_overlays.h"
#include "ui/overlay/scale_bar_view.h"

#include <utility>
#include <variant>

namespace marsview {

FlatPictures::FlatPictures(TerrainView& view, MapOverlays& overlays)
    : PictureScene(&view)
    , view_(view)
    , overlays_(overlays)
{
    connect(&view, &TerrainView::layersChanged, this, &PictureScene::layersChanged);
    connect(&view, &TerrainView::lookChanged, this, &PictureScene::lookChanged);
    connect(&view, &TerrainView::pictureCompleted, this, &PictureScene::pictureCompleted);
    connect(&view, &TerrainView::sightChanged, this, &PictureScene::sightChanged);
}

bool FlatPictures::isReady() const
{
    return view_.isReady() && view_.map() != nullptr;
}

bool FlatPictures::isComplete() const
{
    return view_.isPictureComplete();
}

SceneCamera FlatPictures::camera() const
{
    return view_.camera();
}

void FlatPictures::setCamera(const SceneCamera& camera)
{
    view_.setCamera(std::get<OrbitCamera>(camera));
}

bool FlatPictures::isMoving() const
{
    return view_.isMoving();
}

const DrawStyle& FlatPictures::style() const
{
    return view_.style();
}

Viewport FlatPictures::viewport() const
{
    return view_.viewport();
}

double FlatPictures::devicePixelRatio() const
{
    return view_.devicePixelRatioF();
}

int FlatPictures::sideMax()
{
    return view_.pictureSideMax();
}

Result<bool> FlatPictures::drawPart(const SceneCamera& camera,
                                    const DrawStyle& style,
                                    const QRect& part,
                                    const PartOptions& options,
                                    QImage& picture)
{
    return view_.drawPart(std::get<OrbitCamera>(camera), style, part, options, picture);
}

std::vector<PicturePart>
FlatPictures::partsFor(const SceneCamera& camera, const QSize& picture, const PictureParts& parts)
{
    const auto& at = std::get<OrbitCamera>(camera);
    std::vector<PicturePart> made;
    if (parts.has_legend) {
        append(made, platesFor(view_, {overlays_.legend()}, picture));
    }
    if (parts.has_scale) {
        append(made, platesFor(view_, {overlays_.compass(), overlays_.scaleBar()}, picture));
    }
    if (parts.has_labels) {
        append(made, overlays_.labels()->partsFor(at, picture, placesOf(made)));
        const auto contours = [&](const ContourLabelOptions& options, double height_px,
                                  const ContourView::Widths& width_of) {
            return view_.map() ? contourLabels(view_.ground(), at, view_.look(), options, height_px,
                                               width_of)
                               : std::vector<ContourLabel>{};
        };
        append(made, overlays_.contourLabels()->partsFor(contours, picture, placesOf(made)));
    }
    if (parts.has_marks) {
        for (const DrawnMarks* marks : marks_) {
            append(made, marks->partsFor(picture));
        }
    }
    return made;
}

std::optional<SceneCamera>
FlatPictures::cameraFor(const Session& session, const SavedView& view, double exaggeration) const
{
    return sceneCamera(view_, session, view, exaggeration);
}

const Map* FlatPictures::topmost() const
{
    return view_.map().get();
}

CameraPath FlatPictures::aboveGround(const CameraPath& path) const
{
    return path.above([this](double east_m, double north_m) {
        return view_.ground().height(east_m, north_m) * view_.exaggeration();
    });
}

CameraPath FlatPictures::pathThrough(const std::vector<SceneCamera>& cameras, FlightPace pace) const
{
    std::vector<OrbitCamera> flat;
    for (const SceneCamera& camera : cameras) {
        flat.push_back(std::get<OrbitCamera>(camera));
    }
    return aboveGround(CameraPath::throughCameras(flat, pace));
}

CameraPath FlatPictures::pathAlong(const std::vector<ScenePoint>& line,
                                   const LineFlight& flight) const
{
    return aboveGround(CameraPath::alongLine(line, flight));
}

SceneCamera FlatPictures::cameraOn(const CameraPath& path, double share) const
{
    OrbitCamera camera = path.at(share);
    const ScenePoint eye = eyeOf(camera);
    const double ground_z = view_.ground().height(eye.x, eye.y) * view_.exaggeration();
    const double missing_m = ground_z + kClearanceShare * camera.distance_m - eye.z;
    if (missing_m > 0.0) {
        camera.target.z += missing_m;
    }
    return camera;
}

PictureFacts FlatPictures::facts(const QSize& picture) const
{
    const Georeference& georeference = view_.map()->georeference();
    const OrbitCamera& camera = view_.camera();
    PictureFacts facts{
        .maps = {},
        .middle = georeference.sceneFrame().toGrid(camera.target),
        .pixel_m = metersPerPixel(camera, {.width = picture.width(), .height = picture.height()}),
        .heading = camera.azimuth,
        .legend = overlays_.legend()->content()};
    for (const ShownLayer& layer : view_.shownLayers()) {
        facts.maps.push_back(layer.map);
    }
    if (const auto place = viewCamera(georeference, camera, view_.exaggeration())) {
        facts.heading = place->azimuth;
    }
    return facts;
}

std::optional<OrbitCamera> sceneCamera(const TerrainView& view,
                                       const Session& session,
                                       const SavedView& saved,
                                       double exaggeration)
{
    const auto& map = view.map();
    if (!map) {
        return std::nullopt;
    }
    const Body* body = map->info().body;
    const Layer* layer = layerOf(session, saved.layer);
    const bool is_same_map = layer != nullptr && layer->map == map;
    const bool is_same_body = body != nullptr && body->name == saved.body;
    if (!is_same_map && !is_same_body) {
        return std::nullopt;
    }
    return orbitCamera(map->georeference(), saved.camera, exaggeration);
}

} // namespace marsview
