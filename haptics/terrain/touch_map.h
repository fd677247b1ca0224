// A map as contact models touch it: all of a map in memory, or the resident tiles of a tiled map.
#pragma once

#include "core/contact/contact_model.h"
#include "core/session/scene_surface.h"
#include "haptics/terrain/clipmap_streamer.h"
#include "haptics/terrain/servo_map.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace marsview {

/// Where a map goes around its body: in the plane its first and last column are apart, on the body
/// they are next to each other.
enum class MapEnds : std::uint8_t { Apart, Meet };

/// The one way from an opened map to its contact models, for the mouse of the window and for the
/// loop of a device. It does not wait for tiles: a tiled map always has its coarsest tile in
/// memory, and a separate thread loads finer ones while the map is touched. For the thread that
/// owns it; the servo thread alone uses what make() returns.
///
///     TouchMap touch({.map = map, .frame = map->georeference().sceneFrame()});
///     settings.map = touch.make(ContactModelKind::ContinuousWalk, exaggeration);
class TouchMap {
public:
    explicit TouchMap(const SceneMap& map, MapEnds ends = MapEnds::Apart);
    /// Maps in tiles on one body, which are touched as one surface, or one of them. The uppermost
    /// first.
    explicit TouchMap(const std::vector<std::shared_ptr<const Map>>& in_tiles);

    /// The uppermost.
    const SceneMap& map() const noexcept { return map_; }
    bool isOf(const SceneMap& map) const { return map.map == map_.map && map.frame == map_.frame; }
    /// Whether the map's surface may change by itself while it is touched.
    bool isTiled() const noexcept { return !streams_.empty(); }

    /// The map with a new model, from now on with tiles around the hand. `radius_m` is that of the
    /// model's sphere, half a cell if empty. Null for a map in memory whose voids have not been
    /// filled.
    std::shared_ptr<ServoMap>
    make(ContactModelKind kind, double exaggeration, std::optional<double> radius_m = std::nullopt);
    /// The same of a map in tiles on its body; the mesh is that of the map.
    std::shared_ptr<ServoMap>
    make(ContactModelKind kind, const std::shared_ptr<const TiledBodyMesh>& mesh, double radius_m);
    /// The maps in tiles joined, also with others: `mesh` has been made from `tiled`, one for each
    /// map in tiles. `maps` are all of them, the uppermost first, or nothing if there will be no
    /// recording.
    std::shared_ptr<ServoMap> make(ContactModelKind kind,
                                   const std::vector<std::shared_ptr<const TiledBodyMesh>>& tiled,
                                   const LayeredMesh& mesh,
                                   std::vector<std::shared_ptr<const Georeference>> maps,
                                   double radius_m);
    /// The hand is gone: loading stops.
    void release();

    /// For a hand without a servo loop, such as the mouse: reports its position and applies newly
    /// loaded tiles at once, since a jump of the surface cannot be felt. Returns true if the
    /// surface has changed: the model of `made`, which make() returned, has been notified and needs
    /// an update.
    bool follow(ServoMap& made, const ScenePoint& hand);

    /// Of loading tiles of the uppermost map in tiles; empty without one.
    std::optional<ClipmapStreamerStatistics> statistics() const;

private:
    struct Stream {
        std::unique_ptr<ClipmapStreamer> streamer;
        std::shared_ptr<ServoTerrain> terrain;
    };

    static Stream streamOf(const Map& map, MapEnds ends);
    void stream();

    SceneMap map_;
    std::uint64_t map_id_;
    std::vector<Stream> streams_; // one per map in tiles
    bool is_streaming_ = false;
};

} // namespace marsview
