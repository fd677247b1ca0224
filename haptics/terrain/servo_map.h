// A map as the servo thread uses it.
#pragma once

#include "core/body/body_mesh.h"
#include "core/body/layered_mesh.h"
#include "core/body/tiled_body_mesh.h"
#include "core/contact/contact_model.h"
#include "core/contact/goal_frame.h"
#include "core/terrain/filled_heightfield.h"
#include "haptics/terrain/servo_terrain.h"
#include "haptics/terrain/touch_surface.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace marsview {

/// A map in tiles of a ServoMap.
struct ServoTiles {
    std::size_t map = 0; // 0 is that of ServoMap::frame, the next ones are those of `below`
    std::shared_ptr<ServoTerrain> terrain;
};

/// Created and destroyed by any thread except the servo thread; used only by the servo thread.
struct ServoMap {
    GoalFrame frame; // in the plane; a recording on the body takes from it which map this is
    std::unique_ptr<ContactModel> model;
    MapContactModel* map_model = nullptr; // the same model; null on the body
    std::unique_ptr<const TouchSurface> surface;
    std::vector<ServoTiles> tiles{};              // the uppermost first; none if all is in memory
    ContactModelKind kind = kContactModelDefault; // of the model
    double radius_m = 1.0;                        // of the model's sphere, if it has one
    std::uint64_t map_id = 0;                     // identifies the touched map
    std::uint64_t serial = 0;                     // unique for each ServoMap
    bool is_touched = false;                      // the model already has a proxy
    /// On the body, the maps below that of `frame` which are joined with it to one surface, the
    /// uppermost first.
    std::vector<std::shared_ptr<const Georeference>> below{};
};

/// The nearest position on the grid of a map.
inline GridPoint onGrid(const Georeference& map, const GridPoint& at) noexcept
{
    const auto along = [](double value, std::size_t count) {
        const auto last = static_cast<double>(count - 1);
        return value >= 0.0 ? std::min(value, last) : 0.0; // also for NaN
    };
    return {along(at.column, map.columns()), along(at.row, map.rows())};
}

/// Another number at every call, for ServoMap::map_id.
std::uint64_t nextMapId();

struct ServoMapOptions {
    ContactModelKind kind = kContactModelDefault;
    ContactModelOptions contact{};
    std::uint64_t map_id = 1;
};

/// A map in memory.
std::shared_ptr<ServoMap> makeServoMap(const GoalFrame& frame,
                                       std::shared_ptr<const FilledHeightfield> filled,
                                       const ServoMapOptions& options);
/// A tiled map. Several ServoMaps that the servo thread uses one after the other may share the
/// terrain.
std::shared_ptr<ServoMap> makeServoMap(const GoalFrame& frame,
                                       std::shared_ptr<ServoTerrain> terrain,
                                       const ServoMapOptions& options);
/// A map on its body, with the exaggeration of the mesh. Goals and proxies in recordings are
/// longitude, latitude and elevation (BodyGoalFrame).
std::shared_ptr<ServoMap> makeServoMap(const std::shared_ptr<const Georeference>& georeference,
                                       const std::shared_ptr<const BodyMesh>& mesh,
                                       const ServoMapOptions& options);
/// A map in tiles on its body. As with those in the plane, several may share the terrain.
std::shared_ptr<ServoMap> makeServoMap(const std::shared_ptr<const Georeference>& georeference,
                                       const std::shared_ptr<const TiledBodyMesh>& mesh,
                                       std::shared_ptr<ServoTerrain> terrain,
                                       const ServoMapOptions& options);
/// Several maps on their body, joined to one surface: those of the mesh, in its order. Longitudes
/// in recordings are those around the middle of the uppermost.
std::shared_ptr<ServoMap> makeServoMap(const std::vector<std::shared_ptr<const Georeference>>& maps,
                                       const std::shared_ptr<const LayeredMesh>& mesh,
                                       const ServoMapOptions& options);
/// A map in tiles that is joined with others.
struct TiledLayer {
    std::shared_ptr<const TiledBodyMesh> mesh;
    std::shared_ptr<ServoTerrain> terrain;
};
/// The same with maps in tiles: one of `tiled` for each of those in `mesh`, in its order, from
/// which it has been built. If there will be no recording, `maps` may be only one of them.
std::shared_ptr<ServoMap> makeServoMap(const std::vector<std::shared_ptr<const Georeference>>& maps,
                                       const LayeredMesh& mesh,
                                       const std::vector<TiledLayer>& tiled,
                                       const ServoMapOptions& options);

} // namespace marsview
