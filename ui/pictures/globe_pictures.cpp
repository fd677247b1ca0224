#include "ui/pictures/globe_pictures.h"

#include "ui/globe/globe_labels.h"
#include "ui/globe/globe_view.h"
#include "ui/overlay/annotation_marks.h"
#include "ui/overlay/compass.h"
#include "ui/overlay/contour_labels_view.h"
#include "ui/overlay/globe_overlays.h"
#include "ui/overlay/legend.h"
#include "ui/overlay/measure_marks.h"
#include "ui/overlay/scale_bar_view.h"

#include <utility>
#include <variant>

namespace marsview {

GlobePictures::GlobePictures(GlobeView& globe, GlobeOverlays& overlays)
    : PictureScene(&globe)
    , globe_(globe)
    , overlays_(overlays)
{
    connect(&globe, &GlobeView::placed, this, &PictureScene::layersChanged);
    connect(&globe, &GlobeView::sceneChanged, this, &PictureScene::lookChanged);
    connect(&globe, &GlobeView::pictureCompleted, this, &PictureScene::pictureCompleted);
    connect(&globe, &GlobeView::sightChanged, this, &PictureScene::sightChanged);
}

bool GlobePictures::isReady() const
{
    return globe_.isReady() && globe_.terrain() != nullptr;
}

bool GlobePictures::isComplete() const
{
    return globe_.isPictureComplete();
}

SceneCamera GlobePictures::camera() const
{
    return globe_.camera();
}

void GlobePictures::setCamera(const SceneCamera& camera)
{
    globe_.setCamera(std::get<BodyCamera>(camera));
}

bool GlobePictures::isMoving() const
{
    return globe_.isMoving();
}

const DrawStyle& GlobePictures::style() const
{
    return globe_.style();
}

Viewport GlobePictures::viewport() const
{
    return globe_.viewport();
}

double GlobePictures::devicePixelRatio() const
{
    return globe_.devicePixelRatioF();
}

int GlobePictures::sideMax()
{
    return globe_.pictureSideMax();
}

Result<bool> GlobePictures::drawPart(const SceneCamera& camera,
                                     const DrawStyle& style,
                                     const QRect& part,
                                     const PartOptions& options,
                                     QImage& picture)
{
    return globe_.drawPart(std::get<BodyCamera>(camera), style, part, options, picture);
}

std::vector<PicturePart>
GlobePictures::partsFor(const SceneCamera& camera, const QSize& picture, const PictureParts& parts)
{
    std::vector<PicturePart> made;
    if (parts.has_legend) {
        append(made, platesFor(globe_, {overlays_.legend()}, picture));
    }
    if (parts.has_scale) {
        append(made, platesFor(globe_, {overlays_.compass(), overlays_.scaleBar()}, picture));
    }
    if (parts.has_labels) {
        const auto& at = std::get<BodyCamera>(camera);
        append(made, overlays_.labels()->partsFor(at, picture, placesOf(made)));
        const auto contours = [&](const ContourLabelOptions& options, double height_px,
                                  const ContourView::Widths& width_of) {
            const BodyScene& scene = globe_.scene();
            return scene.isEmpty() ? std::vector<ContourLabel>{}
                                   : contourLabels(scene, poseOf(at, scene.ellipsoid()),
                                                   globe_.look(), options, height_px, width_of);
        };
        append(made, overlays_.contourLabels()->partsFor(contours, picture, placesOf(made)));
    }
    if (parts.has_marks) {
        for (const DrawnMarks* marks : overlays_.marks()) {
            append(made, marks->partsFor(picture));
        }
    }
    return made;
}

std::optional<SceneCamera> GlobePictures::cameraFor(const Session& /*session*/,
                                                    const SavedView& view,
                                                    double exaggeration) const
{
    if (globe_.terrain() == nullptr || globe_.terrain()->map()->info().body->name != view.body) {
        return std::nullopt;
    }
    return bodyCamera(view.camera, exaggeration);
}

const Map* GlobePictures::topmost() const
{
    return globe_.terrain() != nullptr ? globe_.terrain()->map().get() : nullptr;
}

CameraPath GlobePictures::aboveGround(const CameraPath& path) const
{
    return path.above([this](const GeographicPoint& place) {
        return globe_.scene().height(place) * globe_.exaggeration();
    });
}

CameraPath GlobePictures::pathThrough(const std::vector<SceneCamera>& cameras,
                                      FlightPace pace) const
{
    std::vector<BodyCamera> on_body;
    for (const SceneCamera& camera : cameras) {
        on_body.push_back(std::get<BodyCamera>(camera));
    }
    return aboveGround(CameraPath::throughCameras(on_body, pace, globe_.scene().ellipsoid()));
}

CameraPath GlobePictures::pathAlong(const std::vector<ScenePoint>& line,
                                    const LineFlight& flight) const
{
    return aboveGround(CameraPath::alongLine(line, flight, globe_.scene().ellipsoid()));
}

SceneCamera GlobePictures::cameraOn(const CameraPath& path, double share) const
{
    BodyCamera camera = path.bodyCameraAt(share);
    if (globe_.scene().isEmpty()) {
        return camera;
    }
    const Ellipsoid& body = globe_.scene().ellipsoid();
    const BodyPlace eye = placeOf(poseOf(camera, body).eye, body);
    const double ground_m = globe_.scene().height(eye.foot) * globe_.exaggeration();
    const double missing_m = ground_m + kClearanceShare * camera.distance_m - eye.height_m;
    if (missing_m > 0.0) {
        camera.height_m += missing_m;
    }
    return camera;
}

// In the middle of the picture is the topmost layer there, otherwise the topmost of all.
PictureFacts GlobePictures::facts(const QSize& picture) const
{
    const auto ground = globe_.groundAt(QRectF(globe_.rect()).center());
    const std::size_t first = ground ? ground->index : 0;
    const std::vector<ShownLayer>& layers = globe_.layers();
    const BodyCamera& camera = globe_.camera();
    PictureFacts facts{
        .maps = {layers[first].map},
        .middle =
            ground ? ground->hit.grid
                   : layers[first].map->georeference().toGrid(camera.target).value_or(GridPoint{}),
        .pixel_m = globe_.metersPerPointInMiddle() * globe_.height() / picture.height(),
        .heading = camera.azimuth,
        .is_on_body = true,
        .legend = overlays_.legend()->content()};
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (i != first) {
            facts.maps.push_back(layers[i].map);
        }
    }
    return facts;
}

std::optional<BodyCamera> bodyCamera(const ViewCamera& camera, double exaggeration)
{
    const auto* target = std::get_if<GeographicPoint>(&camera.target);
    return target != nullptr
               ? std::optional(BodyCamera{.target = *target,
                                          .height_m = camera.elevation_m * exaggeration,
                                          .distance_m = camera.distance_m,
                                          .azimuth = camera.azimuth,
                                          .tilt = camera.tilt,
                                          .field_of_view = camera.field_of_view})
               : std::nullopt;
}

} // namespace marsview
