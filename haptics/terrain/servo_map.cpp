#include "haptics/terrain/servo_map.h"

#include "core/base/check.h"
#include "core/contact/body_below.h"
#include "core/contact/body_goal_frame.h"
#include "core/contact/layered_surface.h"
#include "core/contact/resident_heights.h"

#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

namespace marsview {
namespace {

std::uint64_t nextSerial()
{
    static std::atomic<std::uint64_t> last{0};
    return last.fetch_add(1, std::memory_order_relaxed) + 1;
}

template <typename Surface>
class FlatTouch final : public TouchSurface {
public:
    FlatTouch(GoalFrame frame, Surface surface)
        : frame_(std::move(frame))
        , surface_(std::move(surface))
    {}

    ScenePoint toScene(const TracePoint& goal) const noexcept override
    {
        return frame_.toScene(goal);
    }
    TracePoint fromScene(const ScenePoint& point) const noexcept override
    {
        return frame_.fromScene(point);
    }
    bool isClamped(const TracePoint& goal) const noexcept override
    {
        return frame_.isClamped(goal);
    }
    ScenePoint overMap(const ScenePoint& point) const noexcept override
    {
        return frame_.frame().toScene(below(point), point.z);
    }
    Vec3 beyondMap(const ScenePoint& point) const noexcept override
    {
        const SceneFrame& frame = frame_.frame();
        const GridPoint grid = frame.toGrid(point);
        const GridPoint inside = marsview::onGrid(frame_.georeference(), grid);
        return inside == grid ? Vec3{} : point - frame.toScene(inside, point.z);
    }
    double clearance(const ScenePoint& point) const noexcept override
    {
        return point.z - surface_.height(below(point));
    }
    OnGrid onGrid(const ScenePoint& point, std::size_t /*tiles*/) const noexcept override
    {
        return {below(point)};
    }
    HighWay highWay(const ScenePoint& proxy, const TracePoint& goal) const noexcept override
    {
        constexpr double kAboveAllM = 1e6;
        const TracePoint last = frame_.fromScene(proxy);
        return {.goals = {{{last.x, last.y, kAboveAllM}, {goal.x, goal.y, kAboveAllM}}},
                .count = 2};
    }
    const Ellipsoid* body() const noexcept override { return nullptr; }

private:
    GridPoint below(const ScenePoint& point) const noexcept
    {
        return marsview::onGrid(frame_.georeference(), frame_.frame().toGrid(point));
    }

    GoalFrame frame_;
    Surface surface_;
};

// Whether a pull presses a proxy against a wall.
bool isAgainstWall(const LayeredMesh& mesh, const ScenePoint& proxy, const Vec3& pull) noexcept
{
    constexpr double kReachM = 1e-4; // positions on a planet are known to a nanometer
    const Vec3 around{kReachM, kReachM, kReachM};
    bool is_against = false;
    mesh.tree().inBox(proxy - around, proxy + around, [&](BodyIndex face) {
        if (is_against || !mesh.isWall(face)) {
            return;
        }
        const auto corners = mesh.points(face);
        TriangleTree::Bounds bounds;
        for (const ScenePoint& corner : corners) {
            bounds.add(corner - around);
            bounds.add(corner + around);
        }
        const bool is_near = proxy.x >= bounds.low.x && proxy.x <= bounds.high.x &&
                             proxy.y >= bounds.low.y && proxy.y <= bounds.high.y &&
                             proxy.z >= bounds.low.z && proxy.z <= bounds.high.z;
        const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
        is_against = is_near && dot(pull, normal) < 0.0 &&
                     std::abs(dot(proxy - corners[0], normal)) <= kReachM * length(normal);
    });
    return is_against;
}

template <typename Surface>
class BodyTouch final : public TouchSurface {
public:
    BodyTouch(const BodyGoalFrame& frame,
              Surface surface,
              const std::vector<std::shared_ptr<const BodyLocator>>& locators)
        : frame_(frame)
        , surface_(std::move(surface))
    {
        for (const auto& locator : locators) {
            tiles_.push_back({.locator = locator});
        }
    }

    ScenePoint toScene(const TracePoint& goal) const noexcept override
    {
        return frame_.toScene(goal);
    }
    TracePoint fromScene(const ScenePoint& point) const noexcept override
    {
        return frame_.fromScene(point);
    }
    bool isClamped(const TracePoint& /*goal*/) const noexcept override { return false; }
    ScenePoint overMap(const ScenePoint& point) const noexcept override
    {
        return below(point).over;
    }
    Vec3 beyondMap(const ScenePoint& point) const noexcept override
    {
        const BodyBelow& found = below(point);
        return found.is_beside ? point - found.over : Vec3{};
    }
    double clearance(const ScenePoint& point) const noexcept override
    {
        return below(point).clearance_m;
    }
    OnGrid onGrid(const ScenePoint& point, std::size_t tiles) const noexcept override
    {
        const BodyLocator& locator = *tiles_[tiles].locator;
        std::optional<GridPoint>& at = tiles_[tiles].at;
        const BodyGrid& grid = locator.grid();
        if constexpr (isJoined()) {
            const double radius_m = grid.ellipsoid().equatorial_m;
            if (!locator.isNear(point * (radius_m / length(point)), locator.reachM())) {
                at.reset();
                return {.at = {}, .is_near = false};
            }
        }
        const BodyVertical vertical = verticalAt(grid.ellipsoid(), point);
        const auto found = locator.find(point - vertical.up * vertical.height_m, at);
        at = found ? found : at.value_or(GridPoint{});
        const double turn = columnsPerTurn(tiles);
        if (turn > 0.0) {
            at->column -= turn * std::floor(at->column / turn);
        }
        const auto along = [](double value, std::size_t count) {
            return std::clamp(value, 0.0, static_cast<double>(count - 1));
        };
        at = {along(at->column, grid.columns()), along(at->row, grid.rows())};
        const BodyGrid::Steps steps =
            grid.steps(static_cast<std::size_t>(at->column), static_cast<std::size_t>(at->row));
        return {*at, length(steps.column) / length(steps.row)};
    }
    double columnsPerTurn(std::size_t tiles) const noexcept override
    {
        const BodyGrid& grid = tiles_[tiles].locator->grid();
        return grid.closes() ? static_cast<double>(grid.positions().columns()) : 0.0;
    }
    // Between two points three radii from the center, less than a right angle apart, a straight
    // path stays more than two radii from it.
    HighWay highWay(const ScenePoint& proxy, const TracePoint& goal) const noexcept override
    {
        const double radius_m = frame_.ellipsoid().equatorial_m;
        const double high_m = 2.0 * radius_m / frame_.exaggeration();
        const TracePoint last = frame_.fromScene(proxy);
        const TracePoint begin{last.x, last.y, high_m};
        const TracePoint end{goal.x, goal.y, high_m};
        const Vec3 from = frame_.toScene(begin);
        const Vec3 to = frame_.toScene(end);
        if (dot(from, to) > 0.0) {
            return {.goals = {{begin, end}}, .count = 2};
        }
        constexpr double kOpposite = 1e-3;
        Vec3 between = from + to;
        if (length(between) < kOpposite * radius_m) {
            between =
                std::abs(from.z) < 0.5 * length(from) ? Vec3{0.0, 0.0, 1.0} : Vec3{1.0, 0.0, 0.0};
        }
        const TracePoint over = frame_.fromScene(normalized(between) * (3.0 * radius_m));
        return {.goals = {{begin, over, end}}, .count = 3};
    }
    bool isHeldByWall(const ScenePoint& proxy, const TracePoint& goal) const noexcept override
    {
        if constexpr (isJoined()) {
            const ScenePoint to = frame_.toScene(goal);
            return isAgainstWall(*surface_.mesh(), proxy, to - proxy) &&
                   -clearanceOver(surface_, to) < length(to - proxy);
        } else {
            return false;
        }
    }
    const Ellipsoid* body() const noexcept override { return &frame_.ellipsoid(); }

private:
    struct Tiles {
        std::shared_ptr<const BodyLocator> locator;
        std::optional<GridPoint> at{}; // found last
    };

    static constexpr bool isJoined() noexcept { return std::is_same_v<Surface, LayeredSurface>; }
    // A tick asks several times for the same point.
    const BodyBelow& below(const ScenePoint& point) const noexcept
    {
        if (!(point == asked_)) {
            asked_ = point;
            below_ = belowOn(surface_, point, below_.level_m);
        }
        return below_;
    }

    BodyGoalFrame frame_;
    Surface surface_;
    mutable std::vector<Tiles> tiles_; // of the maps in tiles
    mutable ScenePoint asked_{std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0};
    mutable BodyBelow below_; // of asked_
};

template <typename Surface>
std::shared_ptr<ServoMap> madeOf(const GoalFrame& frame,
                                 const Surface& surface,
                                 std::shared_ptr<ServoTerrain> terrain,
                                 const ServoMapOptions& options)
{
    std::unique_ptr<MapContactModel> model =
        makeContactModel(options.kind, surface, options.contact);
    MapContactModel* const map_model = model.get();
    auto map = std::make_shared<ServoMap>(
        ServoMap{.frame = frame,
                 .model = std::move(model),
                 .map_model = map_model,
                 .surface = std::make_unique<FlatTouch<Surface>>(frame, surface),
                 .kind = options.kind,
                 .radius_m = options.contact.radius_m,
                 .map_id = options.map_id,
                 .serial = nextSerial()});
    if (terrain) {
        map->tiles.push_back({.map = 0, .terrain = std::move(terrain)});
    }
    return map;
}

// A BodyMesh, or maps that are joined to one.
template <typename Surface, typename Mesh>
std::shared_ptr<ServoMap> bodyMapOf(const std::shared_ptr<const Georeference>& georeference,
                                    const std::shared_ptr<const Mesh>& mesh,
                                    const ServoMapOptions& options,
                                    const std::vector<std::shared_ptr<const BodyLocator>>& locators)
{
    const Surface surface(mesh);
    const BodyGoalFrame frame =
        bodyGoalFrame(*georeference, mesh->ellipsoid(), mesh->exaggeration());
    return std::make_shared<ServoMap>(
        ServoMap{.frame = GoalFrame(georeference, mesh->exaggeration()),
                 .model = makeContactModel(options.kind, surface, options.contact),
                 .surface = std::make_unique<BodyTouch<Surface>>(frame, surface, locators),
                 .kind = options.kind,
                 .radius_m = options.contact.radius_m,
                 .map_id = options.map_id,
                 .serial = nextSerial()});
}

} // namespace

std::uint64_t nextMapId()
{
    static std::atomic<std::uint64_t> last{0};
    return last.fetch_add(1, std::memory_order_relaxed) + 1;
}

std::shared_ptr<ServoMap> makeServoMap(const GoalFrame& frame,
                                       std::shared_ptr<const FilledHeightfield> filled,
                                       const ServoMapOptions& options)
{
    const HeightfieldSurface surface(std::move(filled), frame.frame(), frame.exaggeration());
    return madeOf(frame, surface, nullptr, options);
}

std::shared_ptr<ServoMap> makeServoMap(const GoalFrame& frame,
                                       std::shared_ptr<ServoTerrain> terrain,
                                       const ServoMapOptions& options)
{
    const TiledHeightfieldSurface surface(terrain->terrain(), frame.frame(), frame.exaggeration());
    return madeOf(frame, surface, std::move(terrain), options);
}

std::shared_ptr<ServoMap> makeServoMap(const std::shared_ptr<const Georeference>& georeference,
                                       const std::shared_ptr<const BodyMesh>& mesh,
                                       const ServoMapOptions& options)
{
    return bodyMapOf<BodySurface>(georeference, mesh, options, {});
}

std::shared_ptr<ServoMap> makeServoMap(const std::shared_ptr<const Georeference>& georeference,
                                       const std::shared_ptr<const TiledBodyMesh>& mesh,
                                       std::shared_ptr<ServoTerrain> terrain,
                                       const ServoMapOptions& options)
{
    auto map = bodyMapOf<BodySurface>(georeference, mesh->over(terrain->terrain()), options,
                                      {mesh->locator()});
    map->tiles.push_back({.map = 0, .terrain = std::move(terrain)});
    return map;
}

std::shared_ptr<ServoMap> makeServoMap(const std::vector<std::shared_ptr<const Georeference>>& maps,
                                       const std::shared_ptr<const LayeredMesh>& mesh,
                                       const ServoMapOptions& options)
{
    MARSVIEW_CHECK(maps.size() == mesh->mapCount());
    auto map = bodyMapOf<LayeredSurface>(maps.front(), mesh, options, {});
    map->below.assign(maps.begin() + 1, maps.end());
    return map;
}

std::shared_ptr<ServoMap> makeServoMap(const std::vector<std::shared_ptr<const Georeference>>& maps,
                                       const LayeredMesh& mesh,
                                       const std::vector<TiledLayer>& tiled,
                                       const ServoMapOptions& options)
{
    const std::vector<std::size_t> in_tiles = mesh.tiledMaps();
    MARSVIEW_CHECK(maps.size() == 1 || maps.size() == mesh.mapCount());
    MARSVIEW_CHECK(tiled.size() == in_tiles.size());
    std::vector<std::shared_ptr<const BodyMesh>> meshes;
    std::vector<std::shared_ptr<const BodyLocator>> locators;
    std::vector<ServoTiles> tiles;
    for (std::size_t i = 0; i < tiled.size(); ++i) {
        const auto& [shape, terrain] = tiled[i];
        meshes.push_back(shape->over(terrain->terrain(), mesh.map(in_tiles[i])->pins()));
        locators.push_back(shape->locator());
        tiles.push_back({.map = in_tiles[i], .terrain = terrain});
    }
    auto map = bodyMapOf<LayeredSurface>(maps.front(), mesh.over(meshes), options, locators);
    map->tiles = std::move(tiles);
    map->below.assign(maps.begin() + 1, maps.end());
    return map;
}

} // namespace marsview
