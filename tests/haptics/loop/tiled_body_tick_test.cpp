// The tick over a map in tiles on its body.
#include "core/body/tiled_body_mesh.h"
#include "core/contact/body_surface.h"
#include "haptics/interaction/body_frame.h"
#include "haptics/loop/haptic_tick.h"
#include "haptics/loop/rt_scope.h"
#include "tests/core/contact/body_maps.h"
#include "tests/haptics/loop/tick_fixture.h"
#include "tests/haptics/terrain/tiled_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace marsview::test {
namespace {

constexpr double kTiledTickS = 1e-3;
constexpr double kTiledScenePerMeter = 2e6; // the relief is 4 mm high in the workspace

// A hand over a map around Mars of several tiles.
struct TiledRig {
    std::shared_ptr<const Georeference> georeference;
    DeviceCapabilities device = desktopDevice();
    TickOptions options = tickOptionsFor(device);
    LoopSettings settings;
    TickState state;
    TickInput input;
    std::uint64_t allocations = 0;

    StepResult at(const WorkspacePoint& hand)
    {
        input.settings = &settings;
        input.device = &device;
        input.now += std::chrono::milliseconds(1);
        input.sample.position = hand;
        input.sample.time = input.now;
        const RtScope scope;
        const std::uint64_t before = RtScope::allocationCount();
        const StepResult result = step(options, input, state, kTiledTickS);
        allocations += RtScope::allocationCount() - before;
        return result;
    }
    StepResult to(double z_m)
    {
        StepResult last;
        const double begin_m = state.hand.z;
        constexpr int kTicks = 200;
        for (int i = 1; i <= kTicks; ++i) {
            last = at({0.0, 0.0, begin_m + (z_m - begin_m) * i / kTicks});
        }
        return last;
    }
};

class TiledBodyTick : public testing::TestWithParam<std::pair<double, double>> {
protected:
    TiledRig rigOver(std::shared_ptr<ServoMap> map) const
    {
        TiledRig rig;
        rig.settings.map = std::move(map);
        rig.settings.frame = frame_;
        rig.settings.frame_number = 1;
        rig.settings.stiffness_n_per_m = 400.0;
        rig.options.is_passivity_kept = false;
        return rig;
    }
    void SetUp() override
    {
        JobMonitor monitor;
        const auto grid = BodyGrid::make(*georeference_, monitor).value();
        mesh_ = BodyMesh::build(map_.filled, *georeference_, 1.0, monitor).value();
        tiled_ = TiledBodyMesh::build(grid, map_.heights, 1.0, monitor).value();
        const BodySite site{.place = {.longitude = Angle::degrees(GetParam().first),
                                      .latitude = Angle::degrees(GetParam().second)}};
        frame_ = frameOverSite(mesh_->ellipsoid(), site,
                               {.minimum = {-1.0, -1.0, -1.0}, .maximum = {1.0, 1.0, 1.0}},
                               desktopDevice().workspace);
        frame_.scene_per_meter = kTiledScenePerMeter;
        frame_.place =
            frame_.place - frame_.body_axes->z * clearanceOver(BodySurface(mesh_), frame_.place);
    }

    TiledMap map_ = tiledMap(fractalMap(wholeMars(600, 300))->heightfield());
    std::shared_ptr<const Georeference> georeference_ =
        std::make_shared<const Georeference>(georeferenceOf(wholeMars(600, 300)));
    std::shared_ptr<const BodyMesh> mesh_;
    std::shared_ptr<const TiledBodyMesh> tiled_;
    WorkspaceFrame frame_;
};

// While only the coarsest tile is there, while the others are blended in, and afterwards, when the
// force is that over the map in memory.
TEST_P(TiledBodyTick, TilesThatArriveBelowAHandChangeItsForceSlowly)
{
    const auto top = std::make_shared<const Clipmap>(map_.window({0.0, 0.0}, {.wraps = true}));
    const auto exchange = std::make_shared<ClipmapExchange>(top);
    const auto terrain = std::make_shared<ServoTerrain>(exchange, map_.heights,
                                                        ResidentTerrainOptions{.wraps = true});
    TiledRig tiles = rigOver(makeServoMap(georeference_, tiled_, terrain, {}));
    TiledRig memory = rigOver(makeServoMap(georeference_, mesh_, {}));
    constexpr double kHighM = 0.02;
    constexpr double kDeepM = -0.004;
    tiles.to(kHighM);
    StepResult last = tiles.to(kDeepM);
    ASSERT_EQ(last.reason, ForceOffReason::None);
    const HandMotion motion = exchange->motion.read();
    EXPECT_TRUE(motion.is_active);

    auto whole = std::make_shared<Clipmap>(map_.window({0.0, 0.0}, {.wraps = true}));
    for (const TileId& id : tilesOf(*whole)) {
        if (id.level < map_.layout().topLevel()) {
            whole->put(map_.tile(id), 0.0);
        }
    }
    for (const TileId& id : tilesOf(*whole)) {
        if (id.level < map_.layout().topLevel()) {
            whole->put(map_.tile(id), whole->differenceFromCoarser(id));
        }
    }
    exchange->windows.back() = whole;
    exchange->windows.publish();
    double fastest_n_per_s = 0.0;
    int changes = 0;
    for (int tick = 0; tick < 3000 && (tick < 2 || last.has_ground_changed); ++tick) {
        const Vec3 before_n = last.force_n;
        last = tiles.at({0.0, 0.0, kDeepM});
        ASSERT_TRUE(std::isfinite(length(last.force_n)));
        ASSERT_EQ(last.reason, ForceOffReason::None);
        fastest_n_per_s = std::max(fastest_n_per_s, length(last.force_n - before_n) / kTiledTickS);
        changes += last.has_ground_changed ? 1 : 0;
    }
    EXPECT_GT(changes, 1);
    EXPECT_LE(fastest_n_per_s, tiles.options.limits.rate_n_per_s_max * (1.0 + 1e-9));

    tiles.to(kHighM);
    memory.to(kHighM);
    tiles.to(kDeepM);
    memory.to(kDeepM);
    StepResult expected;
    for (int tick = 0; tick < 2000; ++tick) { // the force ramps in
        last = tiles.at({0.0, 0.0, kDeepM});
        expected = memory.at({0.0, 0.0, kDeepM});
    }
    EXPECT_TRUE(expected.contact.is_in_contact);
    EXPECT_NEAR(length(last.contact.proxy - expected.contact.proxy), 0.0, 1e-6);
    EXPECT_NEAR(length(last.force_n - expected.force_n), 0.0, 1e-6);
    EXPECT_EQ(last.missed_samples, 0U);
    EXPECT_EQ(tiles.allocations, 0U);
}

// Inside the map, next to its seam, and next to its poles.
INSTANTIATE_TEST_SUITE_P(Places,
                         TiledBodyTick,
                         testing::Values(std::pair{40.0, 30.0},
                                         std::pair{0.05, -20.0},
                                         std::pair{200.0, 89.8},
                                         std::pair{10.0, -89.9}));

} // namespace
} // namespace marsview::test
