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
    return globe_.meshes().ground()->surfaces[index].canBePressed();
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

// The map with that index, and what it is joined with.
std::vector<BodyTerrain> GlobeHandScene::surfaceOf(std::size_t index) const
{
    const GlobeMeshes::Ground& ground = *globe_.meshes().ground();
    std::vector<BodyTerrain> maps;
    for (const std::size_t i : ground.joinedWith(index)) {
        maps.push_back(ground.scene.maps()[i]);
    }
    return maps;
}

void GlobeHandScene::touch(std::size_t index)
{
    const GlobeMeshes::Ground& ground = *globe_.meshes().ground();
    const BodyStylus::Surface& surface = ground.surfaces[index];
    touched_ = Touched{.maps = surfaceOf(index),
                       .map_id = nextMapId(),
                       .joined = surface.joined,
                       .radius_m = surface.radius_m,
                       .tiled = tiledOf(index)};
    std::vector<std::shared_ptr<const Map>> in_tiles;
    for (const std::size_t i : ground.joinedWith(index)) {
        if (ground.surfaces[i].tiled) {
            in_tiles.push_back(ground.surfaces[i].map);
        }
    }
    if (!in_tiles.empty()) {
        touched_->tiles = std::make_unique<TouchMap>(in_tiles);
    }
}

// Of the map with that index and those that it is joined with, those in tiles.
std::vector<std::shared_ptr<const TiledBodyMesh>> GlobeHandScene::tiledOf(std::size_t index) const
{
    const GlobeMeshes::Ground& ground = *globe_.meshes().ground();
    std::vector<std::shared_ptr<const TiledBodyMesh>> tiled;
    for (const std::size_t i : ground.joinedWith(index)) {
        if (ground.surfaces[i].tiled) {
            tiled.push_back(ground.surfaces[i].tiled);
        }
    }
    return tiled;
}

// Of several maps, the uppermost, as long as all are shown in their order.
std::optional<std::size_t> GlobeHandScene::touched() const
{
    const auto& ground = globe_.meshes().ground();
    if (!touched_ || !ground) {
        return std::nullopt;
    }
    std::optional<std::size_t> first;
    std::size_t next = 0;
    const auto& maps = ground->scene.maps();
    for (std::size_t i = 0; i < maps.size() && next < touched_->maps.size(); ++i) {
        if (isSameMap(maps[i], touched_->maps[next])) {
            first = first.value_or(i);
            ++next;
        }
    }
    return next == touched_->maps.size() ? first : std::nullopt;
}

// While the maps of the scene are not joined yet, a surface of earlier ones stays.
bool GlobeHandScene::isTouched(std::size_t index) const
{
    const GlobeMeshes::Ground& ground = *globe_.meshes().ground();
    const auto is_same = [&](const BodyTerrain& map) {
        return isSameMap(map, ground.scene.maps()[index]);
    };
    if (!touched_ || std::none_of(touched_->maps.begin(), touched_->maps.end(), is_same)) {
        return false;
    }
    if (!ground.surfaces[index].joined) {
        return touched_->maps.size() == 1 || !globe_.meshes().isComplete();
    }
    const std::vector<BodyTerrain> maps = surfaceOf(index);
    return std::equal(maps.begin(), maps.end(), touched_->maps.begin(), touched_->maps.end(),
                      isSameMap);
}

QString GlobeHandScene::whyApart() const
{
    const auto& ground = globe_.meshes().ground();
    return ground ? ground->why_apart : QString();
}

std::shared_ptr<ServoMap> GlobeHandScene::make(ContactModelKind kind) const
{
    const auto index = *touched();
    const BodyStylus::Surface& surface = globe_.meshes().ground()->surfaces[index];
    // At another exaggeration the same maps are joined again.
    const bool is_joined = surface.joined && isTouched(index);
    const auto& joined = is_joined ? surface.joined : touched_->joined;
    std::vector<std::shared_ptr<const Georeference>> maps;
    for (const BodyTerrain& terrain : touched_->maps) {
        maps.emplace_back(terrain.map(), &terrain.map()->georeference());
    }
    if (touched_->tiles) {
        if (maps.size() == 1) {
            return touched_->tiles->make(kind, surface.tiled, touched_->radius_m);
        }
        const auto tiled = is_joined ? tiledOf(index) : touched_->tiled;
        return touched_->tiles->make(kind, tiled, *joined, maps, touched_->radius_m);
    }
    const ServoMapOptions options{
        .kind = kind, .contact = {.radius_m = touched_->radius_m}, .map_id = touched_->map_id};
    return maps.size() == 1 ? makeServoMap(maps.front(), surface.mesh, options)
                            : makeServoMap(maps, joined, options);
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
