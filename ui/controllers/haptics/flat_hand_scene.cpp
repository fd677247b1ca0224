#include "ui/controllers/haptics/flat_hand_scene.h"

#include "haptics/interaction/workspace_walls.h"
#include "ui/canvas/terrain_view.h"
#include "ui/controllers/hand_sight.h"

#include <algorithm>
#include <iterator>

namespace marsview {

FlatHandScene::FlatHandScene(TerrainView& view, QObject* parent)
    : HandScene(parent)
    , view_(view)
{
    connect(&view_, &TerrainView::layersChanged, this, &HandScene::mapsChanged);
    connect(&view_, &TerrainView::exaggerationChanged, this, &HandScene::exaggerationChanged);
    connect(&view_, &TerrainView::sightChanged, this, &HandScene::sightChanged);
    connect(&view_, &TerrainView::pictureCompleted, this, &HandScene::pictureCompleted);
    connect(&view_, &TerrainView::stylusMoved, this, &HandScene::stylusMoved);
    connect(&view_, &TerrainView::grabbingChanged, this, &HandScene::grabbingChanged);
    connect(&view_, &TerrainView::toolChanged, this, &HandScene::toolChanged);
}

std::vector<std::shared_ptr<const Map>> FlatHandScene::maps() const
{
    std::vector<std::shared_ptr<const Map>> maps;
    for (const SceneMap& map : view_.ground().maps()) {
        maps.push_back(map.map);
    }
    return maps;
}

double FlatHandScene::exaggeration() const
{
    return view_.exaggeration();
}

std::optional<std::size_t> FlatHandScene::mapAt(const ScenePoint& hand) const
{
    return view_.ground().mapAt(hand.x, hand.y);
}

void FlatHandScene::touch(std::size_t index)
{
    map_ = std::make_unique<TouchMap>(view_.ground().maps()[index]);
}

std::optional<std::size_t> FlatHandScene::touched() const
{
    const auto& maps = view_.ground().maps();
    const auto found = std::find_if(
        maps.begin(), maps.end(), [this](const SceneMap& map) { return map_ && map_->isOf(map); });
    return found != maps.end()
               ? std::optional(static_cast<std::size_t>(std::distance(maps.begin(), found)))
               : std::nullopt;
}

std::shared_ptr<ServoMap> FlatHandScene::make(ContactModelKind kind) const
{
    return map_->make(kind, view_.exaggeration());
}

WorkspaceFrame FlatHandScene::fittedFrame(const WorkspaceBox& workspace) const
{
    return frameForSight(view_.camera(), view_.viewport(), view_.ground(), view_.exaggeration(),
                         workspace);
}

bool FlatHandScene::isEmpty() const
{
    return view_.ground().isEmpty();
}

HeightRange FlatHandScene::heightRange() const
{
    const SceneBox box = view_.ground().box(view_.exaggeration());
    return {.minimum_m = box.minimum.z, .maximum_m = box.maximum.z};
}

NavigationLimits FlatHandScene::limits() const
{
    const SceneSurface& ground = view_.ground();
    return navigationLimits(ground.box(view_.exaggeration()), ground.pixelMeters());
}

void FlatHandScene::fit(const WorkspaceBox& workspace, LoopSettings& settings)
{
    link_.begin({.camera = view_.camera(), .frame = fittedFrame(workspace)}, limits(), settings);
}

bool FlatHandScene::keepsWorkspace()
{
    return link_.keeps(view_.camera());
}

LinkStep
FlatHandScene::follow(const LoopFrame& loop, const WorkspaceBox& workspace, LoopSettings& settings)
{
    return link_.follow(
        loop, limits(), settings,
        [this](const OrbitCamera& camera) {
            view_.setCamera(camera);
            return view_.camera();
        },
        [&] { return fittedFrame(workspace); });
}

std::optional<WorkspaceBox> FlatHandScene::strokes(const WorkspaceBox& workspace) const
{
    return strokesInSight(view_.camera(), view_.viewport(), view_.ground(), view_.exaggeration(),
                          link_.view().frame, reachWithin(workspace));
}

double FlatHandScene::highestTerrainIn(const WorkspaceBox& rectangle) const
{
    return marsview::highestTerrainIn(rectangle, view_.ground(), view_.exaggeration(),
                                      link_.view().frame);
}

void FlatHandScene::show(const std::optional<StylusPose>& pose)
{
    view_.showDevice(pose);
}

const std::optional<StylusPose>& FlatHandScene::shownStylus() const
{
    return view_.shownStylus();
}

bool FlatHandScene::isInPicture(const ScenePoint& place) const
{
    return view_.isInPicture(place);
}

bool FlatHandScene::isMoving() const
{
    return view_.isMoving();
}

SceneCamera FlatHandScene::cameraGoal() const
{
    return view_.cameraGoal();
}

void FlatHandScene::flyTo(const SceneCamera& camera)
{
    if (const auto* flat = std::get_if<OrbitCamera>(&camera)) {
        view_.flyTo(*flat);
    }
}

void FlatHandScene::flyToPlace(const ScenePoint& place)
{
    view_.flyToPlace(place);
}

bool FlatHandScene::isPlacing() const
{
    return view_.isPlacing();
}

void FlatHandScene::pressStylus(const ScenePoint& place)
{
    view_.pressStylus(place);
}

void FlatHandScene::releaseStylus()
{
    view_.releaseStylus();
}

} // namespace marsview
