#include "ui/globe/globe_hand_scene.h"

#include "haptics/interaction/stroke_area.h"
#include "haptics/interaction/workspace_walls.h"
#include "ui/globe/globe_view.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace marsview {

GlobeHandScene::GlobeHandScene(GlobeView& globe, QObject* parent)
    : HandScene(parent)
    , globe_(globe)
{
    connect(&globe_.meshes(), &GlobeMeshes::groundChanged, this, &HandScene::mapsChanged);
    connect(&globe_, &GlobeView::sightChanged, this, &HandScene::sightChanged);
    connect(&globe_, &GlobeView::pictureCompleted, this, &HandScene::pictureCompleted);
    connect(&globe_, &GlobeView::stylusMoved, this, &HandScene::stylusMoved);
    connect(&globe_, &GlobeView::grabbingChanged, this, &HandScene::grabbingChanged);
    connect(&globe_, &GlobeView::toolChanged, this, &HandScene::toolChanged);
}

void GlobeHandScene::setInUse(bool is_in_use)
{
    globe_.meshes().setWanted(GlobeMeshes::User::Device, is_in_use);
}

std::vector<std::shared_ptr<const Map>> GlobeHandScene::maps() const
{
    std::vector<std::shared_ptr<const Map>> maps;
    if (const auto& ground = globe_.meshes().ground()) {
        for (const BodyTerrain& terrain : ground->scene.maps()) {
            maps.push_back(terrain.map());
        }
    }
    return maps;
}

double GlobeHandScene::exaggeration() const
{
    const auto& ground = globe_.meshes().ground();
    return ground ? ground->exaggeration : globe_.exaggeration();
}

bool GlobeHandScene::canTouch(std::size_t index) const
{
    return globe_.meshes().ground()->surfaces[index].mesh != nullptr;
}

QString GlobeHandScene::whyNone() const
{
    const GlobeMeshes& meshes = globe_.meshes();
    return meshes.isPreparing() && !meshes.ground() ? tr("Preparing the terrain for touch…")
                                                    : meshes.problem();
}

std::optional<std::size_t> GlobeHandScene::mapAt(const ScenePoint& hand) const
{
    const BodyScene& scene = globe_.meshes().ground()->scene;
    return scene.mapAt(placeOf(hand, scene.ellipsoid()).foot);
}

void GlobeHandScene::touch(std::size_t index)
{
    touched_ =
        Touched{.terrain = globe_.meshes().ground()->scene.maps()[index], .map_id = nextMapId()};
}

std::optional<std::size_t> GlobeHandScene::touched() const
{
    const auto& ground = globe_.meshes().ground();
    if (!touched_ || !ground) {
        return std::nullopt;
    }
    const auto& maps = ground->scene.maps();
    const auto found = std::find_if(maps.begin(), maps.end(), [this](const BodyTerrain& terrain) {
        return terrain.map() == touched_->terrain.map() &&
               terrain.grid() == touched_->terrain.grid();
    });
    return found != maps.end()
               ? std::optional(static_cast<std::size_t>(std::distance(maps.begin(), found)))
               : std::nullopt;
}

std::shared_ptr<ServoMap> GlobeHandScene::make(ContactModelKind kind) const
{
    const BodyStylus::Surface& surface = globe_.meshes().ground()->surfaces[*touched()];
    const auto& map = touched_->terrain.map();
    return makeServoMap(
        {map, &map->georeference()}, surface.mesh,
        {.kind = kind, .contact = {.radius_m = surface.radius_m}, .map_id = touched_->map_id});
}

BodyGround GlobeHandScene::ground() const
{
    return [this](const GeographicPoint& place) {
        return globe_.scene().height(place) * globe_.exaggeration();
    };
}

WorkspaceFrame GlobeHandScene::fittedFrame(const WorkspaceBox& workspace) const
{
    return frameForBodyView(globe_.camera(), globe_.viewport(), ground(),
                            globe_.scene().ellipsoid(), reachWithin(workspace));
}

bool GlobeHandScene::isEmpty() const
{
    return globe_.scene().isEmpty();
}

HeightRange GlobeHandScene::heightRange() const
{
    const HeightRange range = globe_.scene().range();
    return {.minimum_m = range.minimum_m * globe_.exaggeration(),
            .maximum_m = range.maximum_m * globe_.exaggeration()};
}

double GlobeHandScene::heightOf(const ScenePoint& place) const
{
    return placeOf(place, globe_.scene().ellipsoid()).height_m;
}

void GlobeHandScene::fit(const WorkspaceBox& workspace, LoopSettings& settings)
{
    link_.begin({.camera = globe_.camera(),
                 .frame = fittedFrame(workspace),
                 .body = globe_.scene().ellipsoid()},
                globe_.limits(), settings);
}

bool GlobeHandScene::keepsWorkspace()
{
    return link_.keeps(globe_.camera());
}

LinkStep
GlobeHandScene::follow(const LoopFrame& loop, const WorkspaceBox& workspace, LoopSettings& settings)
{
    return link_.follow(
        loop, globe_.limits(), settings,
        [this](const BodyCamera& camera) {
            globe_.setCamera(camera);
            return globe_.camera();
        },
        [&] { return fittedFrame(workspace); });
}

// Not where a hand that presses straight down would slip off the ball.
std::optional<WorkspaceBox> GlobeHandScene::strokes(const WorkspaceBox& workspace) const
{
    const WorkspaceFrame& frame = link_.view().frame;
    const Ellipsoid& body = globe_.scene().ellipsoid();
    const CameraPose pose = poseOf(globe_.camera(), body);
    const Viewport viewport = globe_.viewport();
    const double up_least = std::cos(Angle::degrees(45.0).radians());
    return strokeArea(
        reachWithin(workspace), viewport,
        [&, height = ground()](const WorkspacePoint& at) -> std::optional<PixelPoint> {
            const auto terrain = terrainAlong(frame, at, height, body);
            const Vec3 up = terrain ? localAxes(body, placeOf(*terrain, body).foot).up : Vec3{};
            const bool is_of_use = terrain && dot(up, pose.eye - *terrain) > 0.0 &&
                                   dot(up, frame.body_axes->z) > up_least;
            return is_of_use ? project(pose, viewport, *terrain) : std::nullopt;
        });
}

double GlobeHandScene::highestTerrainIn(const WorkspaceBox& rectangle) const
{
    const WorkspaceFrame& frame = link_.view().frame;
    return highestIn(rectangle, [&, height = ground()](const WorkspacePoint& at) {
        const auto terrain = terrainAlong(frame, at, height, globe_.scene().ellipsoid());
        return terrain ? frame.toWorkspace(*terrain).z : std::numeric_limits<double>::quiet_NaN();
    });
}

void GlobeHandScene::show(const std::optional<StylusPose>& pose)
{
    globe_.showDevice(pose);
}

const std::optional<StylusPose>& GlobeHandScene::shownStylus() const
{
    return globe_.shownStylus();
}

bool GlobeHandScene::isInPicture(const ScenePoint& place) const
{
    return globe_.isInPicture(place);
}

bool GlobeHandScene::isMoving() const
{
    return globe_.isMoving();
}

SceneCamera GlobeHandScene::cameraGoal() const
{
    return globe_.cameraGoal();
}

void GlobeHandScene::flyTo(const SceneCamera& camera)
{
    if (const auto* on_body = std::get_if<BodyCamera>(&camera)) {
        globe_.flyTo(*on_body);
    }
}

void GlobeHandScene::flyToPlace(const ScenePoint& place)
{
    globe_.flyTo(placeOf(place, globe_.scene().ellipsoid()).foot, 0.0);
}

bool GlobeHandScene::isPlacing() const
{
    return globe_.isPlacing();
}

void GlobeHandScene::pressStylus(const ScenePoint& place)
{
    globe_.pressStylus(place);
}

void GlobeHandScene::releaseStylus()
{
    globe_.releaseStylus();
}

} // namespace marsview
