// A hand that strokes over maps on top of each other on a body: the simulated hand, tick, frame and
// camera together.
#include "haptics/drivers/simulated/simulated_hand.h"
#include "haptics/interaction/body_frame.h"
#include "haptics/loop/camera_link.h"
#include "haptics/loop/haptic_tick.h"
#include "haptics/loop/rt_scope.h"
#include "tests/core/contact/nested_maps.h"
#include "tests/haptics/loop/tick_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
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
        : limits_{.ellipsoid = maps.body(),
                  .area = {.middle = site, .reach = Angle::degrees(60.0)},
                  .lowest_m = -1e4,
                  .highest_m = 1e4,
                  .distance_min_m = 1e2,
                  .distance_max_m = 1e8}
    {
        settings_.map = maps.servoMap();
        WorkspaceFrame frame = frameOverSite(
            maps.body(), {.place = site},
            {.minimum = {-1.0, -1.0, -1.0}, .maximum = {1.0, 1.0, 1.0}}, device_.workspace);
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

// Pressed with a steady aim of the grip, 10 mm below the surface: a millimeter is 100 m. From
// below, the step holds the hand until that is above it; from above it drops off.
TEST(LayeredTick, AStepIsAWallFromBelowAndAnEdgeFromAbove)
{
    for (const double exaggeration : {1.0, 5.0}) {
        const JoinedMaps maps(levelStepOfSmallCells(), exaggeration);
        Stroke stroke(maps, maps.placeOn(0, {40.0, 16.0}), 1e5); // beside the eastern border
        const double step_m = kStepM * exaggeration / 1e5;
        // Cells of 3 km lie 0.66 m below their heights in the middle of their diagonals.
        constexpr double kCellsM = 0.7 / 1e5;
        const auto proxy = [&] { return stroke.frame().toWorkspace(stroke.last().contact.proxy); };
        // The workspace is level, and the body is not, 3 km from its middle: by x² / 2R.
        constexpr double kLevelM = 1.4 / 1e5;
        stroke.to({0.03, 0.0, 0.02});
        stroke.to({0.03, 0.0, -0.01});
        stroke.rest();
        EXPECT_NEAR(proxy().z, 0.0, kCellsM + kLevelM);
        const double pressed_n = stroke.newtons();
        EXPECT_NEAR(pressed_n, 150.0 * 400.0 / 550.0 * 0.01, 0.01); // of two springs

        stroke.to({-0.01, 0.0, -0.01});
        stroke.rest();
        EXPECT_NEAR(proxy().x, 0.0, 1e-6) << "the foot of the wall";
        EXPECT_NEAR(proxy().z, 0.0, kCellsM);
        EXPECT_NEAR(stroke.last().force_n.x, 150.0 * 400.0 / 550.0 * 0.01, 0.01);
        EXPECT_NEAR(stroke.last().force_n.z, pressed_n, 0.01);

        // Raised, the hand takes the proxy up along the wall, to its own height.
        int risen = 0;
        stroke.each_tick = [&](const Stroke& now) {
            const double height_m = now.last().hand.z;
            if (height_m > 1e-4 && height_m < step_m - 1e-4 && now.last().hand.x < -1e-4) {
                ++risen;
                ASSERT_TRUE(now.last().contact.is_in_contact);
                ASSERT_NEAR(proxy().x, 0.0, 1e-6);
                ASSERT_NEAR(proxy().z, height_m, 2e-6);
            }
        };
        stroke.to({-0.01, 0.0, step_m + 0.01});
        EXPECT_GT(risen, 20);
        stroke.each_tick = {};
        stroke.rest();
        EXPECT_FALSE(stroke.last().contact.is_in_contact) << "above the upper map";

        stroke.to({-0.01, 0.0, step_m - 0.01});
        stroke.rest();
        EXPECT_NEAR(proxy().z, step_m, kCellsM + kLevelM);
        EXPECT_NEAR(stroke.newtons(), pressed_n, 0.01);
        stroke.to({0.02, 0.0, step_m - 0.01}, 0.1);
        stroke.rest();
        const double depth_m = 0.01 - step_m;
        EXPECT_NEAR(stroke.newtons(), 150.0 * 400.0 / 550.0 * std::max(0.0, depth_m), 0.01);
        EXPECT_NEAR(stroke.last().hand.z, depth_m > 0.0 ? -depth_m * 150.0 / 550.0 : step_m - 0.01,
                    1e-4);
        // One surface: no other map begins, and the force never changes faster than it may.
        EXPECT_EQ(stroke.mapChanges(), 1);
        EXPECT_LE(stroke.stepMaxN(), stroke.rateNPerS() * kTickS + 1e-9);
        EXPECT_EQ(stroke.allocations(), 0U);
    }
}

} // namespace
} // namespace marsview::test
