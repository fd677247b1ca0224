// A hand that strokes over maps on top of each other on a body: the simulated hand, tick, frame and
// camera together.
#include "core/base/plain_number.h"
#include "core/contact/layered_surface.h"
#include "core/feather/feathered_map.h"
#include "haptics/drivers/simulated/simulated_hand.h"
#include "haptics/interaction/body_frame.h"
#include "haptics/loop/camera_link.h"
#include "haptics/loop/haptic_tick.h"
#include "haptics/loop/rt_scope.h"
#include "haptics/terrain/ground_log.h"
#include "haptics/trace/goal_file.h"
#include "haptics/trace/ground_text.h"
#include "haptics/trace/recorded_ground.h"
#include "haptics/trace/replay_check.h"
#include "tests/core/contact/nested_maps.h"
#include "tests/haptics/loop/tick_fixture.h"
#include "tests/haptics/terrain/tiled_layers.h"
#include "tests/support/map_maker.h"
#include "tests/support/shared_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace marsview::test {
namespace {

constexpr double kTickS = 1e-3;

class JoinedMaps {
public:
    JoinedMaps(const NestedMaps& nested, double exaggeration)
        : meshes_(meshesOf(nested, exaggeration))
    {
        JobMonitor monitor;
        const auto mesh = LayeredMesh::build(meshes_, monitor);
        EXPECT_TRUE(mesh) << (mesh ? "" : mesh.error().message);
        mesh_ = *mesh;
        for (const NestedMap& map : nested.maps) {
            georeferences_.push_back(std::make_shared<const Georeference>(georeferenceOf(map.map)));
        }
    }

    const Ellipsoid& body() const { return mesh_->ellipsoid(); }
    std::shared_ptr<ServoMap> servoMap() const { return makeServoMap(georeferences_, mesh_, {}); }
    // Maps that are open, the uppermost first, on the ellipsoid of the lowest.
    JoinedMaps(const std::vector<std::shared_ptr<const Map>>& maps, double exaggeration)
    {
        JobMonitor monitor;
        for (const auto& map : maps) {
            georeferences_.emplace_back(map, &map->georeference());
            meshes_.push_back(BodyMesh::build(map->filled(), map->georeference(), exaggeration,
                                              monitor,
                                              *maps.back()->georeference().crs()->ellipsoid())
                                  .value());
        }
        mesh_ = LayeredMesh::build(meshes_, monitor).value();
    }

    const std::vector<std::shared_ptr<const Georeference>>& georeferences() const
    {
        return georeferences_;
    }
    GeographicPoint placeOn(std::size_t map, const GridPoint& at) const
    {
        return *georeferences_[map]->toGeographic(at);
    }

private:
    std::vector<std::shared_ptr<const BodyMesh>> meshes_;
    std::shared_ptr<const LayeredMesh> mesh_;
    std::vector<std::shared_ptr<const Georeference>> georeferences_;
};

// With the limiter's default rates. The camera follows the frame sixty times a
// second.
class Stroke {
public:
    Stroke(const JoinedMaps& maps, const GeographicPoint& site, double scene_per_meter)
        : Stroke(maps.body(), maps.servoMap(), site, scene_per_meter)
    {}
    Stroke(const Ellipsoid& body,
           std::shared_ptr<ServoMap> map,
           const GeographicPoint& site,
           double scene_per_meter)
        : limits_{.ellipsoid = body,
                  .area = {.middle = site, .reach = Angle::degrees(60.0)},
                  .lowest_m = -1e4,
                  .highest_m = 1e4,
                  .distance_min_m = 1e2,
                  .distance_max_m = 1e8}
    {
        settings_.map = std::move(map);
        WorkspaceFrame frame = frameOverSite(
            body, {.place = site}, {.minimum = {-1.0, -1.0, -1.0}, .maximum = {1.0, 1.0, 1.0}},
            device_.workspace);
        frame.scene_per_meter = scene_per_meter;
        settings_.stiffness_n_per_m = 400.0;
        camera_ = constrained({.target = site, .distance_m = 0.16 * scene_per_meter}, limits_,
                              [](const GeographicPoint&) { return 0.0; });
        link_.begin({.camera = camera_, .frame = frame, .body = limits_.ellipsoid}, limits_,
                    settings_);
    }

    // Moves the aim of the grip there.
    void to(const WorkspacePoint& aim, double m_per_s = 0.05)
    {
        const Vec3 way = aim - aim_;
        const int ticks = std::max(1, static_cast<int>(length(way) / m_per_s / kTickS));
        const WorkspacePoint begin = aim_;
        for (int i = 1; i <= ticks; ++i) {
            aim_ = begin + way * (static_cast<double>(i) / ticks);
            hand_.aimAt(aim_, way * (1.0 / (ticks * kTickS)));
            tick();
        }
        hand_.aimAt(aim_);
    }
    // Across, with the aim of the grip so far below the surface that is below the hand.
    void across(double x, double depth_m, double m_per_s = 0.05)
    {
        const int ticks = static_cast<int>(std::abs(x - aim_.x) / m_per_s / kTickS);
        const double step_m = (x - aim_.x) / ticks;
        for (int i = 0; i < ticks; ++i) {
            aim_.x += step_m;
            aim_.z = std::isfinite(last_.surface_z_m) ? last_.surface_z_m - depth_m : aim_.z;
            hand_.aimAt(aim_);
            tick();
        }
    }
    void rest(int ticks = 300)
    {
        for (int i = 0; i < ticks; ++i) {
            tick();
        }
    }

    const StepResult& last() const { return last_; }
    double newtons() const { return length(last_.force_n); }
    double stepMaxN() const { return step_max_n_; }
    int mapChanges() const { return map_changes_; }
    int groundChanges() const { return ground_changes_; }
    // As in a recording.
    struct Goal {
        TracePoint goal;
        TracePoint proxy;
    };
    const std::vector<Goal>& goals() const { return goals_; }
    std::uint64_t allocations() const { return allocations_; }
    double rateNPerS() const { return options_.limits.rate_n_per_s_max; }
    const WorkspaceFrame& frame() const { return state_.frame; }
    std::function<void(const Stroke&)> each_tick; // called after every one

private:
    void tick()
    {
        TickInput input;
        input.settings = &settings_;
        input.device = &device_;
        now_ += std::chrono::milliseconds(1);
        input.now = now_;
        input.sample.position = hand_.measured();
        input.sample.time = now_;
        {
            const RtScope scope;
            const std::uint64_t before = RtScope::allocationCount();
            const Vec3 force_n = last_.force_n;
            last_ = step(options_, input, state_, kTickS);
            allocations_ += RtScope::allocationCount() - before;
            step_max_n_ = std::max(step_max_n_, length(last_.force_n - force_n));
        }
        map_changes_ += last_.has_changed_map ? 1 : 0;
        ground_changes_ += last_.has_ground_changed ? 1 : 0;
        for (std::size_t i = 0; i < last_.goals.count; ++i) {
            goals_.push_back({last_.goals.goals[i], last_.goals.proxies[i]});
        }
        hand_.push(last_.force_n);
        hand_.advance(kTickS);
        if (++ticks_ % 16 == 0) {
            link_.follow(
                {.seen = state_.seen_frame,
                 .number = state_.frame_number,
                 .mode = state_.modes.mode},
                limits_, settings_,
                [this](const BodyCamera& wanted) {
                    return camera_ = constrained(wanted, limits_,
                                                 [](const GeographicPoint&) { return 0.0; });
                },
                [this] { return settings_.frame; });
        }
        if (each_tick) {
            each_tick(*this);
        }
    }

    DeviceCapabilities device_ = desktopDevice();
    TickOptions options_ = tickOptionsFor(device_);
    BodyLimits limits_;
    LoopSettings settings_;
    TickState state_;
    BodyCamera camera_;
    BodyCameraLink link_;
    SimulatedHand hand_{{}, {0.0, 0.0, 0.03}};
    WorkspacePoint aim_{0.0, 0.0, 0.03};
    StepResult last_;
    std::chrono::steady_clock::time_point now_{std::chrono::seconds(1)};
    double step_max_n_ = 0.0;
    int map_changes_ = 0;
    int ground_changes_ = 0;
    std::vector<Goal> goals_;
    int ticks_ = 0;
    std::uint64_t allocations_ = 0;
};

const char* const kTransverse = "+proj=tmerc +lat_0=18 +lon_0=226 +R=3396190 +units=m";
constexpr double kStepM = 200.0;

// Level maps with cells of 1 and 3 km, which lie within 0.7 m of their heights.
NestedMaps levelStepOfSmallCells()
{
    return {"SmallCells",
            {{{"Fine", kTransverse, 41, 33, {-20500, 1000, 0, 16500, 0, -1000}, 0.0}, kStepM},
             {{"Coarse", "+proj=longlat +R=3396190", 81, 81, {224, 0.05, 0, 20, 0, -0.05}, 0.0}}}};
}

// Of a grip whose aim is so far inside: two springs, and what they balance in between.
constexpr double kShareOfAim = 150.0 / 550.0;
constexpr double kNewtonsPerMeter = 400.0 * kShareOfAim;

class LayeredTick : public testing::TestWithParam<double> {
protected:
    // A millimeter is 100 m. Beside the eastern border of the upper map, x is 0.
    static constexpr double kMetersPerMeter = 1e5;
    // Cells of 3 km lie 0.66 m below their heights in the middle of their diagonals, and the
    // surface 1.3 m below the level workspace at 3 km from its middle, by x² / 2R.
    static constexpr double kLevelM = 2.1 / kMetersPerMeter;

    WorkspacePoint proxy() const
    {
        return stroke_.frame().toWorkspace(stroke_.last().contact.proxy);
    }
    void expectOneSurfaceAndNoStep() const
    {
        EXPECT_EQ(stroke_.mapChanges(), 1) << "no other map begins";
        EXPECT_LE(stroke_.stepMaxN(), stroke_.rateNPerS() * kTickS + 1e-9);
        EXPECT_EQ(stroke_.allocations(), 0U);
    }

    const JoinedMaps maps_{levelStepOfSmallCells(), GetParam()};
    const double step_m_ = kStepM * GetParam() / kMetersPerMeter;
    Stroke stroke_{maps_, maps_.placeOn(0, {40.0, 16.0}), kMetersPerMeter};
};

TEST_P(LayeredTick, AStepHoldsTheHandUntilItIsRaisedAndDropsItFromAbove)
{
    stroke_.to({0.03, 0.0, 0.02});
    stroke_.to({0.03, 0.0, -0.01});
    stroke_.rest();
    EXPECT_NEAR(proxy().z, 0.0, kLevelM);
    const double pressed_n = stroke_.newtons();
    EXPECT_NEAR(pressed_n, 0.01 * kNewtonsPerMeter, 0.01);

    constexpr double kInsideM = 0.001;
    stroke_.to({-kInsideM / kShareOfAim, 0.0, -0.01});
    stroke_.rest();
    EXPECT_NEAR(proxy().x, 0.0, 1e-6) << "the foot of the wall";
    EXPECT_NEAR(proxy().z, 0.0, kLevelM);
    EXPECT_NEAR(stroke_.last().force_n.x, 0.4, 0.01);
    EXPECT_NEAR(stroke_.last().force_n.z, pressed_n, 0.01);

    // Raised, the hand takes the proxy up along the wall, to its own height, until the upper map is
    // nearer to the hand than the wall.
    int risen = 0;
    stroke_.each_tick = [&](const Stroke& now) {
        const double height_m = now.last().hand.z;
        const double left_m = step_m_ - height_m + now.last().hand.x; // until it is nearer
        if (height_m > 1e-4 && std::abs(left_m) > 2e-4 && now.last().contact.is_in_contact) {
            const bool is_on_wall = left_m > 0.0;
            risen += is_on_wall ? 1 : 0;
            ASSERT_NEAR(proxy().x, is_on_wall ? 0.0 : now.last().hand.x, 1e-5) << height_m;
            ASSERT_NEAR(proxy().z, is_on_wall ? height_m : step_m_, kLevelM) << height_m;
        }
    };
    stroke_.to({-kInsideM / kShareOfAim, 0.0, step_m_ + 0.01});
    EXPECT_GT(risen, 10);
    stroke_.each_tick = {};
    stroke_.rest();
    EXPECT_FALSE(stroke_.last().contact.is_in_contact) << "above the upper map";

    stroke_.to({-0.01, 0.0, step_m_ - 0.01});
    stroke_.rest();
    EXPECT_NEAR(proxy().z, step_m_, kLevelM);
    EXPECT_NEAR(stroke_.newtons(), pressed_n, 0.01);
    stroke_.to({0.02, 0.0, step_m_ - 0.01}, 0.1);
    stroke_.rest();
    const double depth_m = std::max(0.0, 0.01 - step_m_);
    EXPECT_NEAR(stroke_.newtons(), depth_m * kNewtonsPerMeter, 0.01);
    expectOneSurfaceAndNoStep();
}

// With a depth of p, a push of d overcomes a step of h from d² = 2 p h + h² on: then the upper map
// is as near to the hand as the foot of the step, and the force turns without a change of strength.
TEST_P(LayeredTick, APushAcrossOvercomesAStepOnceTheUpperMapIsNearer)
{
    stroke_.to({0.01, 0.0, 0.02});
    stroke_.to({0.01, 0.0, -0.01});
    stroke_.rest();
    const double depth_m = 0.01 * kShareOfAim;
    const double push_m = std::sqrt(2.0 * depth_m * step_m_ + step_m_ * step_m_);
    std::optional<double> held_m; // the largest push that did not overcome it
    double before_m = 0.0;
    double after_m = 0.0; // from the hand to the proxy
    stroke_.each_tick = [&](const Stroke& now) {
        const double distance_m = length(proxy() - now.last().hand);
        if (proxy().z < 0.5 * step_m_) {
            held_m = -now.last().hand.x;
            before_m = distance_m;
        } else if (after_m == 0.0) {
            after_m = distance_m;
        }
    };
    stroke_.to({-1.2 * push_m / kShareOfAim, 0.0, -0.01});
    ASSERT_TRUE(held_m);
    EXPECT_NEAR(*held_m, push_m, 0.02 * push_m + 1e-5);
    EXPECT_NEAR(after_m, before_m, 0.02 * before_m);
    EXPECT_NEAR(proxy().z, step_m_, kLevelM);
    expectOneSurfaceAndNoStep();
}

INSTANTIATE_TEST_SUITE_P(Exaggeration,
                         LayeredTick,
                         testing::Values(1.0, 2.0),
                         [](const auto& tested) {
                             return "Times" + std::to_string(static_cast<int>(tested.param));
                         });

// What a recording has: the maps and the goals. On the same maps, joined again, they give the same
// proxies to the bit, over the wall, too.
TEST(LayeredTickRecorded, ItsGoalsGiveTheSameProxiesOnTheSameMaps)
{
    const NestedMaps nested = levelStepOfSmallCells();
    const JoinedMaps maps(nested, 1.0);
    Stroke stroke(maps, maps.placeOn(0, {40.0, 16.0}), 1e5);
    for (const double x : {0.02, -0.03, 0.01, -0.02}) {
        stroke.to({x, 0.1 * x, -0.01}, 0.2);
    }
    GroundLog log;
    const auto records = std::make_unique<GroundLog::Queue>();
    ASSERT_EQ(log.record(*maps.servoMap(), false, *records), 2U);
    std::string file =
        "lon,lat,z,map,part,model,radius_m,exaggeration,ground,contact,proxy_x,"
        "proxy_y,proxy_z\n0,0,0,1,";
    GroundRecord record;
    std::string ground;
    std::uint64_t part = 0;
    while (records->take(record)) {
        ground += (ground.empty() ? "" : " ") + groundText(record);
        if (const auto* begins = std::get_if<GroundPart>(&record)) {
            part = begins->part;
        }
    }
    file += std::to_string(part) + ",continuous-walk,1,1," + ground + ",0,0,0,0\n";
    const auto recording = readGoalRecording(file, "joined.csv", GoalColumns::Geographic);
    ASSERT_TRUE(recording) << recording.error().message;
    const auto found = mapsOf(recording->parts.front(), maps.georeferences());
    EXPECT_EQ(found, (std::vector<std::size_t>{0, 1}));

    const JoinedMaps again(nested, recording->parts.front().exaggeration);
    const auto map = again.servoMap();
    int on_upper = 0;
    for (const Stroke::Goal& goal : stroke.goals()) {
        const ContactState state = map->model->update(map->surface->toScene(goal.goal));
        ASSERT_EQ(state.is_in_contact ? map->surface->fromScene(state.proxy) : goal.goal,
                  goal.proxy);
        on_upper += state.is_in_contact && goal.proxy.z > 0.9 * kStepM ? 1 : 0;
    }
    EXPECT_GT(on_upper, 100);
    EXPECT_LT(on_upper, static_cast<int>(stroke.goals().size()) - 100);
}

// All of Mars in cells of 15 km, and a part of it in cells of 2 km in a projection of its own,
// raised by 200 m: a stroke over its border and back, with a hand that follows the terrain.
TEST(LayeredTickOnMars, AStrokeOntoAFinerMapAndBackChangesTheForceNoFasterThanItMay)
{
    const auto mars = loadedMap(bundledMars());
    MapMaker maker;
    const MapMaker::Place place{61,
                                61,
                                {-61000, 2000, 0, 61000, 0, -2000},
                                "+proj=tmerc +lat_0=-9 +lon_0=-70 +a=3396190 +b=3376200 +units=m"};
    const Georeference fine(61, 61, *GeoTransform::fromTerms(place.transform),
                            *Crs::fromText(place.srs));
    const auto raised = maker.make(place, [&](std::size_t column, std::size_t row) {
        const auto at = fine.toGeographic({static_cast<double>(column), static_cast<double>(row)});
        return mars->height(*at) + kStepM;
    });
    constexpr double kExaggeration = 5.0;
    const JoinedMaps maps({raised, mars}, kExaggeration);
    Stroke stroke(maps, maps.placeOn(0, {60.0, 30.0}), 1e6); // a millimeter is a kilometer
    int on_upper = 0;
    int on_lower = 0;
    stroke.each_tick = [&](const Stroke& now) {
        if (now.last().contact.is_in_contact) {
            // Beside the border the two differ by the step, and by no more than a sample's height.
            const TracePoint& proxy = now.last().proxy;
            const double above_m = proxy.z - mars->height({.longitude = Angle::degrees(proxy.x),
                                                           .latitude = Angle::degrees(proxy.y)});
            on_upper += std::abs(above_m - kStepM) < 40.0 ? 1 : 0;
            on_lower += std::abs(above_m) < 40.0 ? 1 : 0;
        }
    };
    for (const double x : {0.04, -0.04, 0.04}) {
        stroke.across(x, 0.0075);
    }
    EXPECT_GT(on_upper, 500);
    EXPECT_GT(on_lower, 500);
    EXPECT_EQ(stroke.mapChanges(), 1);
    EXPECT_LE(stroke.stepMaxN(), stroke.rateNPerS() * kTickS + 1e-9);
    EXPECT_EQ(stroke.allocations(), 0U);
}

// Level maps of 1 and 3 km cells; a millimeter is 300 m. A hand that follows the terrain strokes
// over the edge and back: there the limiter bounds the change of force, and with a feather it has
// nothing to do.
TEST(LayeredTickOverAFeather, AStrokeOverTheEdgeFeelsASlopeInPlaceOfTheStep)
{
    MapMaker maker;
    const auto level = [](double height_m) {
        return [height_m](std::size_t, std::size_t) { return height_m; };
    };
    const auto upper =
        maker.make({41, 33, {-20500, 1000, 0, 16500, 0, -1000}, kTransverse}, level(kStepM));
    const auto lower =
        maker.make({81, 81, {224, 0.05, 0, 20, 0, -0.05}, "+proj=longlat +R=3396190"}, level(0.0));
    JobMonitor monitor;
    const auto terrain = [&monitor](const std::shared_ptr<const Map>& map) {
        return BodyTerrain(map, BodyGrid::make(map->georeference(), monitor).value());
    };
    const auto blended =
        featheredMap(terrain(upper), std::vector{terrain(lower)}, 15, monitor).value();
    std::vector<double> step_max_n;
    for (const auto& map : {upper, blended}) {
        const JoinedMaps maps({map, lower}, 2.0);
        Stroke stroke(maps, maps.placeOn(0, {40.0, 16.0}), 3e5);
        stroke.to({0.04, 0.0, 0.01});
        stroke.to({0.04, 0.0, -0.005});
        stroke.rest();
        double over_edge_n = 0.0;
        Vec3 last_n = stroke.last().force_n;
        bool is_over_lower = false;
        bool is_over_upper = false;
        stroke.each_tick = [&](const Stroke& now) {
            over_edge_n = std::max(over_edge_n, length(now.last().force_n - last_n));
            last_n = now.last().force_n;
            is_over_lower = is_over_lower || now.last().proxy.z < 0.05 * kStepM;
            is_over_upper = is_over_upper || now.last().proxy.z > 0.95 * kStepM;
        };
        for (const double x : {-0.06, 0.04}) {
            stroke.across(x, 0.005);
        }
        EXPECT_TRUE(is_over_lower);
        EXPECT_TRUE(is_over_upper);
        step_max_n.push_back(over_edge_n);
    }
    std::printf("largest change of force in a tick: %.4f N, with a feather %.4f N\n", step_max_n[0],
                step_max_n[1]);
    EXPECT_GT(step_max_n[0], 0.2);
    EXPECT_LT(step_max_n[1], 0.1 * step_max_n[0]);
}

// The upper map is about 200 m above the lower one; a millimeter is 100 m. One of them or both are
// in tiles.
struct InTiles {
    std::string name;
    NestedMaps maps;
    std::vector<std::size_t> in_tiles;
    std::vector<GridPoint> middles; // of the windows of tiles
    friend std::ostream& operator<<(std::ostream& out, const InTiles& tested)
    {
        return out << tested.name;
    }
};

std::vector<InTiles> inTiles()
{
    const NestedMap fine{{"Fine", kTransverse, 300, 280, {-75000, 500, 0, 70000, 0, -500}, 100.0}};
    const NestedMap coarse{
        {"Coarse", "+proj=longlat +R=3396190", 81, 81, {224, 0.05, 0, 20, 0, -0.05}, 100.0},
        -kStepM};
    // Four tiles meet next to the middle of the eastern border.
    const NestedMap below{{"Below",
                           "+proj=longlat +R=3396190",
                           300,
                           360,
                           {227.36 - 256 * 0.03, 0.03, 0, 18.02 + 256 * 0.03, 0, -0.03},
                           100.0},
                          -kStepM};
    return {{"TheUpper", {"Upper", {fine, coarse}}, {0}, {{150.0, 140.0}}},
            {"TheLower", {"Lower", {fine, below}}, {1}, {{256.0, 256.0}}},
            {"Both", {"Both", {fine, below}}, {0, 1}, {{150.0, 140.0}, {256.0, 256.0}}}};
}

class LayeredTickInTiles : public testing::TestWithParam<InTiles> {
protected:
    enum class Tiles { Coarsest, All };
    using Exchanges = std::vector<std::shared_ptr<ClipmapExchange>>;

    // Of a map in tiles. Bounds of their differences from coarser ones that are so many times too
    // large make blending take so much longer.
    std::shared_ptr<Clipmap> window(std::size_t i, Tiles tiles, double slowness = 1.0) const
    {
        const TiledMap& map = layers_.tiles[i].map;
        auto window = std::make_shared<Clipmap>(map.window(GetParam().middles[i]));
        for (const bool has_coarser : {false, true}) {
            for (const TileId& id : tilesOf(*window)) {
                if (tiles == Tiles::All && id.level < map.layout().topLevel()) {
                    window->put(map.tile(id),
                                has_coarser ? slowness * window->differenceFromCoarser(id) : 0.0);
                }
            }
        }
        return window;
    }
    Exchanges exchanges(Tiles tiles) const
    {
        Exchanges exchanges;
        for (std::size_t i = 0; i < layers_.tiles.size(); ++i) {
            exchanges.push_back(std::make_shared<ClipmapExchange>(window(i, tiles)));
        }
        return exchanges;
    }
    void publish(ClipmapExchange& exchange, std::size_t i, double slowness = 1.0) const
    {
        exchange.windows.back() = window(i, Tiles::All, slowness);
        exchange.windows.publish();
    }
    std::shared_ptr<ServoMap> servoMap(const Exchanges& exchanges) const
    {
        std::vector<TiledLayer> tiled;
        for (std::size_t i = 0; i < layers_.tiles.size(); ++i) {
            const auto& [index, map, mesh] = layers_.tiles[i];
            tiled.push_back({mesh, std::make_shared<ServoTerrain>(exchanges[i], map.heights)});
        }
        return makeServoMap(layers_.georeferences, *layers_.joined, tiled, {});
    }
    Stroke strokeOver(std::shared_ptr<ServoMap> map) const
    {
        // In the middle of the eastern border.
        return {layers_.ellipsoid(), std::move(map),
                *layers_.georeferences[0]->toGeographic({299.0, 139.5}), 1e5};
    }
    static void overTheBorderAndBack(Stroke& stroke)
    {
        for (const double x : {0.03, -0.03, 0.03}) {
            stroke.across(x, 0.0075);
        }
    }

    const TiledLayers layers_{GetParam().maps, GetParam().in_tiles, 1.0};
};

INSTANTIATE_TEST_SUITE_P(Maps,
                         LayeredTickInTiles,
                         testing::ValuesIn(inTiles()),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(LayeredTickInTiles, AStrokeOverTheBorderHasTheForcesOfTheMapsInMemory)
{
    Stroke tiles = strokeOver(servoMap(exchanges(Tiles::All)));
    Stroke memory =
        strokeOver(makeServoMap(layers_.georeferences, layers_.inMemory(layers_.filled()), {}));
    std::vector<Vec3> forces_n;
    tiles.each_tick = [&](const Stroke& now) { forces_n.push_back(now.last().force_n); };
    std::size_t tick = 0;
    int on_upper = 0;
    int on_lower = 0;
    memory.each_tick = [&](const Stroke& now) {
        ASSERT_LT(tick, forces_n.size());
        ASSERT_EQ(forces_n[tick], now.last().force_n) << tick;
        ++tick;
        const bool is_upper = now.last().hand.x < 0.0;
        on_upper += now.last().contact.is_in_contact && is_upper ? 1 : 0;
        on_lower += now.last().contact.is_in_contact && !is_upper ? 1 : 0;
    };
    overTheBorderAndBack(tiles);
    overTheBorderAndBack(memory);
    EXPECT_EQ(tick, forces_n.size());
    EXPECT_GT(on_upper, 200);
    EXPECT_GT(on_lower, 200);
    EXPECT_EQ(tiles.mapChanges(), 1);
    EXPECT_EQ(tiles.allocations(), 0U);
    EXPECT_LE(tiles.stepMaxN(), tiles.rateNPerS() * kTickS + 1e-9);
}

// Those of one map after those of the other.
TEST_P(LayeredTickInTiles, TilesThatArriveDuringAStrokeChangeTheForceNoFasterThanItMay)
{
    const Exchanges windows = exchanges(Tiles::Coarsest);
    Stroke stroke = strokeOver(servoMap(windows));
    overTheBorderAndBack(stroke);
    stroke.across(-0.01, 0.0075);
    EXPECT_EQ(stroke.groundChanges(), 0);
    const double before_n = stroke.newtons();
    EXPECT_GT(before_n, 0.1);
    int changes = 0;
    for (std::size_t i = 0; i < windows.size(); ++i) {
        publish(*windows[i], i);
        overTheBorderAndBack(stroke);
        EXPECT_GT(stroke.groundChanges(), changes) << i;
        changes = stroke.groundChanges();
    }
    EXPECT_EQ(stroke.mapChanges(), 1);
    EXPECT_EQ(stroke.last().missed_samples, 0U);
    EXPECT_EQ(stroke.allocations(), 0U);
    EXPECT_LE(stroke.stepMaxN(), stroke.rateNPerS() * kTickS + 1e-9);
}

// Each streamer learns where the hand is on the grid of its own map.
TEST_P(LayeredTickInTiles, EachMapHasTheMotionOfTheHandOnItsGrid)
{
    const Exchanges windows = exchanges(Tiles::All);
    Stroke stroke = strokeOver(servoMap(windows));
    int checked = 0;
    stroke.each_tick = [&](const Stroke& now) {
        if (!now.last().contact.is_in_contact) {
            return;
        }
        for (std::size_t i = 0; i < windows.size(); ++i) {
            const HandMotion motion = windows[i]->motion.read();
            const Georeference& map = *layers_.georeferences[layers_.tiles[i].index];
            const auto at = map.toGrid(placeOf(now.last().contact.proxy, layers_.ellipsoid()).foot);
            ASSERT_TRUE(motion.is_active);
            ASSERT_TRUE(at);
            const GridPoint on_grid = onGrid(map, *at); // a tick earlier the proxy was 5 m away
            ASSERT_NEAR(motion.at.column, on_grid.column, 2.0) << i;
            ASSERT_NEAR(motion.at.row, on_grid.row, 2.0) << i;
            ++checked;
        }
    };
    overTheBorderAndBack(stroke);
    EXPECT_GT(checked, 500);
}

// North of the middle of the upper map, whose corners are 103 km from there.
TEST_P(LayeredTickInTiles, TilesOfAMapThatIsFurtherAwayThanItIsLargeAreNotLoaded)
{
    const GeographicPoint middle = *layers_.georeferences[0]->toGeographic({149.5, 139.5});
    for (const auto& [distance_m, is_near] :
         {std::pair(0.0, true), std::pair(1e5, true), std::pair(2e5, true), std::pair(2.5e5, false),
          std::pair(1.5e5, true)}) {
        const GeographicPoint site{.longitude = middle.longitude,
                                   .latitude =
                                       middle.latitude + Angle::radians(distance_m / 3396190.0)};
        const Exchanges windows = exchanges(Tiles::All);
        Stroke stroke{layers_.ellipsoid(), servoMap(windows), site, 1e5};
        stroke.rest(3);
        for (std::size_t i = 0; i < windows.size(); ++i) {
            const HandMotion motion = windows[i]->motion.read();
            const bool is_upper = layers_.tiles[i].index == 0;
            EXPECT_EQ(motion.is_active, !is_upper || is_near) << distance_m << " " << i;
            EXPECT_LT(std::abs(motion.rows_per_s), 1e4) << distance_m << " " << i;
        }
        EXPECT_EQ(stroke.allocations(), 0U);
    }
}

// A recording names both maps and whose tiles were there: on the same maps, joined again, each with
// its recorded tiles, the goals give the same proxies to the bit, while tiles of either arrive.
TEST_P(LayeredTickInTiles, ARecordingGivesTheSameProxiesWhileTilesOfEitherMapArrive)
{
    const Exchanges windows = exchanges(Tiles::Coarsest);
    const auto map = servoMap(windows);
    Stroke stroke = strokeOver(map);
    GroundLog log;
    const auto records = std::make_unique<GroundLog::Queue>();
    std::string file =
        "lon,lat,z,map,part,model,radius_m,exaggeration,ground,contact,proxy_x,proxy_y,proxy_z\n";
    const std::string part = std::to_string(map->serial);
    std::size_t next_goal = 0;
    std::string cell;
    stroke.each_tick = [&](const Stroke& now) {
        ASSERT_TRUE(log.record(*map, now.last().has_ground_changed, *records));
        GroundRecord record;
        while (records->take(record)) {
            cell += (cell.empty() ? "" : " ") + groundText(record);
        }
        for (; next_goal < now.goals().size(); ++next_goal) {
            const Stroke::Goal& goal = now.goals()[next_goal];
            file += asText(goal.goal.x) + "," + asText(goal.goal.y) + "," + asText(goal.goal.z) +
                    ",1," + part + ",continuous-walk,1,1," + std::exchange(cell, {}) + ",0," +
                    asText(goal.proxy.x) + "," + asText(goal.proxy.y) + "," + asText(goal.proxy.z) +
                    "\n";
        }
    };
    overTheBorderAndBack(stroke);
    for (std::size_t i = windows.size(); i-- > 0;) {
        publish(*windows[i], i, 100.0);
        overTheBorderAndBack(stroke);
    }
    const auto recording = readGoalRecording(file, "tiles.csv", GoalColumns::Geographic);
    ASSERT_TRUE(recording) << recording.error().message;
    EXPECT_EQ(mapsOf(recording->parts.front(), layers_.georeferences),
              (std::vector<std::size_t>{0, 1}));

    std::vector<std::shared_ptr<RecordedGround>> grounds;
    TiledLayers::Terrains terrains;
    for (const TiledLayerMap& one : layers_.tiles) {
        grounds.push_back(RecordedGround::make(TiledRaster(layers_.cache, one.map.source),
                                               one.map.heights,
                                               static_cast<std::uint32_t>(one.index))
                              .value());
        terrains.push_back(grounds.back()->terrain());
    }
    const auto model =
        makeContactModel(kContactModelDefault, LayeredSurface(layers_.over(terrains)));
    auto ground = recording->ground.begin();
    std::size_t in_contact = 0;
    std::size_t changes = 0;
    for (std::size_t i = 0; i < recording->goals.size(); ++i) {
        for (; ground != recording->ground.end() && ground->goal == i; ++ground) {
            for (const GroundRecord& record : ground->records) {
                for (const auto& one : grounds) {
                    ASSERT_TRUE(one->follow(record));
                }
                const auto* felt = std::get_if<GroundFelt>(&record);
                if (felt != nullptr && felt->changed_part != 0) {
                    model->terrainChanged();
                    ++changes;
                }
            }
        }
        const TracePoint& goal = recording->goals[i];
        const ContactState state = model->update(map->surface->toScene(goal));
        ASSERT_EQ(state.is_in_contact ? map->surface->fromScene(state.proxy) : goal,
                  recording->updates[i].proxy)
            << i;
        in_contact += state.is_in_contact ? 1U : 0U;
    }
    EXPECT_GT(in_contact, 1000U);
    EXPECT_EQ(changes, static_cast<std::size_t>(stroke.groundChanges()));
    EXPECT_GT(changes, 10 * windows.size());
    // Of each map in tiles.
    std::set<std::optional<std::uint32_t>> resident;
    std::set<std::optional<std::uint32_t>> blended;
    for (const GoalGround& one : recording->ground) {
        for (const GroundRecord& record : one.records) {
            if (const auto* level = std::get_if<GroundLevel>(&record)) {
                resident.insert(level->map);
            } else if (const auto* tile = std::get_if<GroundTile>(&record)) {
                blended.insert(tile->map);
            }
        }
    }
    std::set<std::optional<std::uint32_t>> expected;
    for (const TiledLayerMap& one : layers_.tiles) {
        expected.insert(static_cast<std::uint32_t>(one.index));
    }
    EXPECT_EQ(resident, expected);
    EXPECT_EQ(blended, expected);
}

// The upper map in cells of 10 km around the pole, the lower one in cells of half a degree: the
// curvature makes steps of up to 33 m, a few micrometers in the workspace.
TEST(LayeredTickOverAPole, NothingIsFeltOfStepsThatAreSmall)
{
    const JoinedMaps maps(
        {"Pole",
         {{{"Polar",
            "+proj=stere +lat_0=90 +lon_0=0 +R=3396190 +units=m",
            61,
            61,
            {-305000, 10000, 0, 305000, 0, -10000},
            0.0}},
          {{"Whole", "+proj=longlat +R=3396190", 360, 180, {0, 1, 0, 90, 0, -1}, 0.0}}}},
        1.0);
    Stroke stroke(maps, {.longitude = Angle(), .latitude = Angle::degrees(90.0)}, 1e7);
    // A ball with a radius of 338 mm. 2.7 mm below its surface, from 80° N over the pole to 80° N.
    const double radius_m = 3376200.0 / 1e7;
    const auto along = [&](double x) {
        return WorkspacePoint{x, 0.3 * x,
                              std::sqrt(radius_m * radius_m - 1.09 * x * x) - radius_m - 0.01};
    };
    stroke.to(along(-0.06) + Vec3{0.0, 0.0, 0.02});
    stroke.to(along(-0.06));
    stroke.rest();
    const double pressed_n = stroke.newtons();
    int on_upper = 0;
    stroke.each_tick = [&](const Stroke& now) {
        ASSERT_TRUE(now.last().contact.is_in_contact);
        ASSERT_NEAR(now.newtons(), pressed_n, 0.05);
        on_upper += std::abs(now.last().hand.x) < 0.028 ? 1 : 0;
    };
    for (int i = -120; i <= 120; ++i) {
        stroke.to(along(0.0005 * i));
    }
    EXPECT_GT(on_upper, 500);
    EXPECT_EQ(stroke.mapChanges(), 1);
    EXPECT_EQ(stroke.allocations(), 0U);
}

} // namespace
} // namespace marsview::test
