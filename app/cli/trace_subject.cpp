#include "app/cli/trace_subject.h"

#include "app/cli/pile_mesh.h"
#include "core/body/tiled_body_mesh.h"
#include "core/contact/body_goal_frame.h"
#include "core/contact/body_surface.h"
#include "core/contact/layered_surface.h"
#include "core/contact/resident_heights.h"
#include "core/mesh/mesh_file.h"
#include "core/session/open_map.h"
#include "haptics/trace/replay_check.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fmt/format.h>
#include <utility>

namespace marsview {
namespace {

// Over a map: heights are those of `sample`, x and y are in the CRS.
TraceFrame frameOf(const GoalFrame& frame)
{
    return {
        .to_scene = [frame](const TracePoint& goal) { return frame.toScene(goal); },
        .from_scene = [frame](const ContactState& state) { return frame.fromScene(state.proxy); },
        .is_clamped = [frame](const TracePoint& goal) { return frame.isClamped(goal); },
    };
}

// Over a mesh: coordinates are scene meters, without the exaggeration.
TraceFrame meshFrame(double exaggeration)
{
    return {
        .to_scene = [exaggeration](const TracePoint& goal) -> ScenePoint {
            return {goal.x, goal.y, goal.z * exaggeration};
        },
        .from_scene =
            [exaggeration](const ContactState& state) {
                return TracePoint{state.proxy.x, state.proxy.y, state.proxy.z / exaggeration};
            },
        .is_clamped = [](const TracePoint&) { return false; },
    };
}

// On the body: longitude, latitude and elevation.
TraceFrame bodyFrame(const BodyGoalFrame& frame)
{
    return {
        .to_scene = [frame](const TracePoint& goal) { return frame.toScene(goal); },
        .from_scene = [frame](const ContactState& state) { return frame.fromScene(state.proxy); },
        .is_clamped = [](const TracePoint&) { return false; },
    };
}

// The resources with which a recording's map is opened: in tiles, if it was recorded so.
MapResources resourcesFor(const GoalRecording& recording)
{
    MapResources resources = defaultMapResources();
    if (!recording.ground.empty()) {
        resources.held_bytes_max = 0;
    }
    return resources;
}

// The terrain of a map in tiles: that of the recording, if it was made on this map.
Result<std::shared_ptr<const TiledTerrain>>
tiledTerrain(const Map& map, const GoalRecording& recording, TraceSubject& subject)
{
    const Heightfield& heightfield = map.heightfield();
    const TiledRaster& raster = heightfield.tiles()->raster();
    const auto heights = tileHeightsOf(map);
    if (!subject.is_recorded_on || recording.ground.empty()) {
        subject.waiting.push_back(std::make_shared<const WaitingTerrain>(raster, heights));
        return std::shared_ptr<const TiledTerrain>(subject.waiting.back());
    }
    auto recorded = RecordedGround::make(raster, heights);
    if (!recorded) {
        return std::move(recorded).error();
    }
    subject.recorded = std::move(recorded).value();
    return subject.recorded->terrain();
}

// The triangles of a map on its body.
Result<std::shared_ptr<const BodyMesh>> bodyMesh(const Map& map,
                                                 const GoalRecording& recording,
                                                 double exaggeration,
                                                 JobMonitor& monitor,
                                                 TraceSubject& subject)
{
    if (map.filled()) {
        return BodyMesh::build(map.filled(), map.georeference(), exaggeration, monitor);
    }
    auto grid = BodyGrid::make(map.georeference(), monitor);
    if (!grid) {
        return std::move(grid).error();
    }
    auto terrain = tiledTerrain(map, recording, subject);
    if (!terrain) {
        return std::move(terrain).error();
    }
    const auto tiled =
        TiledBodyMesh::build(std::move(grid).value(), tileHeightsOf(map), exaggeration, monitor);
    if (!tiled) {
        return tiled.error();
    }
    return (*tiled)->over(std::move(terrain).value());
}

// The subject's map and those below it.
Status touchPile(const PileOptions& options,
                 double exaggeration,
                 JobMonitor& monitor,
                 TraceSubject& subject)
{
    const auto maps = pileOnBody(subject.map, options, monitor);
    if (!maps) {
        return maps.error();
    }
    auto pile = joinedPile(*maps, exaggeration, monitor);
    if (!pile) {
        return Error{pile.error().code,
                     fmt::format("{}: {}", subject.map->spec().path, pile.error().message)};
    }
    const BodyGoalFrame frame =
        bodyGoalFrame(subject.map->georeference(), pile->joined.mesh->ellipsoid(), exaggeration);
    subject.radius_m = pile->radius_m;
    subject.waiting = pile->joined.waiting;
    subject.make = [surface = LayeredSurface(pile->joined.mesh), frame](const TraceTouch& touch) {
        return Toucher{.model = makeContactModel(touch.kind, surface, {.radius_m = touch.radius_m}),
                       .frame = bodyFrame(frame)};
    };
    return Done{};
}

bool isRecordedOn(const GoalRecording& recording, const Georeference& map)
{
    return !recording.parts.empty() && std::all_of(recording.parts.begin(), recording.parts.end(),
                                                   [&map](const GoalPart& part) {
                                                       return part.ground &&
                                                              isRecordedOn(*part.ground, map);
                                                   });
}

} // namespace

bool isMesh(const std::string& path)
{
    std::string ending = std::filesystem::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending == ".obj" || ending == ".ply" || ending == ".stl";
}

Result<TraceSubject>
meshSubject(const MapOptions& options, double exaggeration, JobMonitor& monitor)
{
    const auto mesh = loadMesh(options.path, exaggeration, monitor);
    if (!mesh) {
        return mesh.error();
    }
    const MeshSurface surface(mesh.value());
    TraceSubject subject;
    subject.make = [surface, exaggeration](const TraceTouch& touch) {
        return Toucher{.model = makeContactModel(touch.kind, surface, {.radius_m = touch.radius_m}),
                       .frame = meshFrame(exaggeration)};
    };
    return subject;
}

Result<TraceSubject> bodySubject(const MapOptions& options,
                                 const PileOptions& pile,
                                 const GoalRecording& recording,
                                 double exaggeration,
                                 JobMonitor& monitor)
{
    const Result<std::shared_ptr<const Map>> opened =
        openMap(options.spec(), resourcesFor(recording), monitor);
    if (!opened) {
        return opened.error();
    }
    const std::shared_ptr<const Map>& map = *opened;
    const Georeference& georeference = map->georeference();
    TraceSubject subject;
    subject.map = map;
    subject.is_on_body = true;
    if (!pile.below.empty()) {
        if (Status joined = touchPile(pile, exaggeration, monitor, subject); !joined) {
            return std::move(joined).error();
        }
        return subject;
    }
    subject.is_recorded_on = isRecordedOn(recording, georeference);
    const auto mesh = bodyMesh(*map, recording, exaggeration, monitor, subject);
    if (!mesh) {
        return Error{mesh.error().code, fmt::format("{}: {}", options.path, mesh.error().message)};
    }
    const BodyGoalFrame frame =
        bodyGoalFrame(georeference, (*mesh)->positions().ellipsoid(), exaggeration);
    subject.radius_m = (georeference.pixelWidthMeters() + georeference.pixelHeightMeters()) / 4.0;
    subject.make = [surface = BodySurface(*mesh), frame](const TraceTouch& touch) {
        return Toucher{.model = makeContactModel(touch.kind, surface, {.radius_m = touch.radius_m}),
                       .frame = bodyFrame(frame)};
    };
    return subject;
}

Result<TraceSubject>
mapSubject(const MapOptions& options, const GoalRecording& recording, JobMonitor& monitor)
{
    Result<std::shared_ptr<const Map>> opened =
        openMap(options.spec(), resourcesFor(recording), monitor);
    if (!opened) {
        return std::move(opened).error();
    }
    const std::shared_ptr<const Map> map = std::move(opened).value();
    TraceSubject subject;
    subject.map = map;
    const Georeference& georeference = map->georeference();
    subject.radius_m = 0.5 * georeference.sceneFrame().meanCellSideM();
    subject.is_recorded_on = isRecordedOn(recording, georeference);
    const auto goal_frame = [map](const TraceTouch& touch) {
        const Georeference& placed = map->georeference();
        return GoalFrame({map, &placed}, touch.frame.value_or(placed.sceneFrame()),
                         touch.exaggeration);
    };
    if (map->filled()) {
        subject.make = [goal_frame, filled = map->filled()](const TraceTouch& touch) {
            const GoalFrame frame = goal_frame(touch);
            const HeightfieldSurface surface(filled, frame.frame(), touch.exaggeration);
            return Toucher{.model =
                               makeContactModel(touch.kind, surface, {.radius_m = touch.radius_m}),
                           .frame = frameOf(frame)};
        };
        return subject;
    }
    auto tiled = tiledTerrain(*map, recording, subject);
    if (!tiled) {
        return std::move(tiled).error();
    }
    subject.make = [goal_frame, terrain = std::move(tiled).value()](const TraceTouch& touch) {
        const GoalFrame frame = goal_frame(touch);
        const TiledHeightfieldSurface surface(terrain, frame.frame(), touch.exaggeration);
        return Toucher{.model = makeContactModel(touch.kind, surface, {.radius_m = touch.radius_m}),
                       .frame = frameOf(frame)};
    };
    return subject;
}

} // namespace marsview
