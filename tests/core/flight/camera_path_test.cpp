#include "core/flight/camera_path.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace marsview {
namespace {

using test::Random;

OrbitCamera anyCamera(Random& random)
{
    return {
        .target = {random.uniform(-1e6, 1e6), random.uniform(-1e6, 1e6), random.uniform(-3e3, 3e3)},
        .distance_m = std::pow(10.0, random.uniform(3.5, 6.5)),
        .azimuth = Angle::degrees(random.uniform(-180.0, 180.0)),
        .tilt = Angle::degrees(random.uniform(0.0, 80.0)),
        .field_of_view = Angle::degrees(40.0)};
}

std::vector<OrbitCamera> randomCameras(Random& random)
{
    std::vector<OrbitCamera> cameras;
    for (std::size_t left = random.below(5) + 2; left > 0; --left) {
        cameras.push_back(anyCamera(random));
    }
    return cameras;
}

double turnBetween(Angle from, Angle to)
{
    return std::remainder((to - from).radians(), 2.0 * std::numbers::pi);
}

// The change of everything from one camera to the next, in units of the distance and in radians.
using Change = std::array<double, 6>;
Change changeBetween(const OrbitCamera& from, const OrbitCamera& to)
{
    const Vec3 step = (to.target - from.target) * (1.0 / from.distance_m);
    return {step.x,
            step.y,
            step.z,
            std::log(to.distance_m / from.distance_m),
            turnBetween(from.azimuth, to.azimuth),
            (to.tilt - from.tilt).radians()};
}

double changeSize(const Change& change)
{
    double sum = 0.0;
    for (const double part : change) {
        sum += part * part;
    }
    return std::sqrt(sum);
}

// The largest jump of the velocity at the given times, against the largest velocity.
double largestJump(const CameraPath& path, const std::vector<double>& shares)
{
    constexpr double kStep = 2e-8;
    double speed_max = 0.0;
    double jump_max = 0.0;
    for (const double share : shares) {
        if (share < 2.0 * kStep || share > 1.0 - 2.0 * kStep) {
            continue;
        }
        const OrbitCamera here = path.at(share);
        const Change before = changeBetween(path.at(share - kStep), here);
        const Change after = changeBetween(here, path.at(share + kStep));
        Change jump;
        for (std::size_t i = 0; i < jump.size(); ++i) {
            jump[i] = after[i] - before[i];
        }
        speed_max = std::max({speed_max, changeSize(before), changeSize(after)});
        jump_max = std::max(jump_max, changeSize(jump));
    }
    return jump_max / speed_max;
}

std::vector<double> manyShares(const CameraPath& path, Random& random)
{
    std::vector<double> shares = path.stops();
    for (int i = 0; i <= 1024; ++i) {
        shares.push_back(i / 1024.0);
    }
    for (int i = 0; i < 1000; ++i) {
        shares.push_back(random.uniform(0.0, 1.0));
    }
    return shares;
}

// Mountains 6 km high, with cliffs.
double cliffs(double x, double y)
{
    const double waves = std::sin(x / 9e3) * std::cos(y / 7e3) + std::sin((x + y) / 31e3);
    return 1500.0 * waves + (std::sin(x / 23e3) > 0.6 ? 3000.0 : 0.0);
}

} // namespace

TEST(CameraPath, ReachesEveryCameraInTurn)
{
    Random random;
    for (int i = 0; i < 200; ++i) {
        const std::vector<OrbitCamera> cameras = randomCameras(random);
        for (const FlightPace pace : {FlightPace::Constant, FlightPace::SlowAtViews}) {
            const CameraPath path = CameraPath::throughCameras(cameras, pace);
            ASSERT_EQ(path.stops().size(), cameras.size());
            EXPECT_EQ(path.stops().front(), 0.0);
            EXPECT_NEAR(path.stops().back(), 1.0, 1e-12);
            for (std::size_t k = 0; k < cameras.size(); ++k) {
                EXPECT_LT(changeSize(changeBetween(cameras[k], path.at(path.stops()[k]))), 1e-5);
            }
            EXPECT_TRUE(std::is_sorted(path.stops().begin(), path.stops().end()));
        }
    }
}

TEST(CameraPath, ItsVelocityIsContinuous)
{
    Random random;
    double worst = 0.0;
    for (int i = 0; i < 60; ++i) {
        const std::vector<OrbitCamera> cameras = randomCameras(random);
        for (const FlightPace pace : {FlightPace::Constant, FlightPace::SlowAtViews}) {
            const CameraPath path = CameraPath::throughCameras(cameras, pace);
            worst = std::max(worst, largestJump(path, manyShares(path, random)));
        }
    }
    EXPECT_LT(worst, 0.01);
}

// There and back: the camera has to stand still for a moment where it turns around.
TEST(CameraPath, ItsVelocityIsContinuousWhereItReturns)
{
    Random random;
    const OrbitCamera home{.target = {0.0, 0.0, 0.0}, .distance_m = 1e4};
    OrbitCamera away = home;
    away.target.x = 5e4;
    OrbitCamera near = home;
    near.distance_m = 500.0;
    for (const OrbitCamera& other : {away, near}) {
        const CameraPath path =
            CameraPath::throughCameras({home, other, home}, FlightPace::Constant);
        EXPECT_LT(largestJump(path, manyShares(path, random)), 0.01);
        EXPECT_NEAR(path.stops()[1], 0.5, 1e-3);
    }
}

// The closed form of the optimal path between equal distances w, u apart: it climbs to
// w·√(1 + (ρ²u/2w)²), with ρ² = 2.
TEST(CameraPath, FarFlightsClimbInAnArc)
{
    const OrbitCamera from{.target = {0.0, 0.0, 0.0}, .distance_m = 2e4};
    for (const double away_m : {1e3, 5e4, 3e6}) {
        OrbitCamera to = from;
        to.target.y = away_m;
        const CameraPath path = CameraPath::throughCameras({from, to}, FlightPace::Constant);
        double highest_m = 0.0;
        for (int i = 0; i <= 2000; ++i) {
            const OrbitCamera camera = path.at(i / 2000.0);
            highest_m = std::max(highest_m, camera.distance_m);
            EXPECT_GE(camera.distance_m, 2e4 * (1.0 - 1e-9));
            EXPECT_EQ(camera.target.x, 0.0);
            EXPECT_GE(camera.target.y, -1e-6);
            EXPECT_LE(camera.target.y, away_m * (1.0 + 1e-9));
        }
        EXPECT_NEAR(highest_m / (2e4 * std::hypot(1.0, away_m / 2e4)), 1.0, 0.01) << away_m;
    }
}

// From a planet to a crater: the camera is over the crater before it is near the ground.
TEST(CameraPath, PansWhileItIsFar)
{
    const OrbitCamera planet{.target = {0.0, 0.0, 0.0}, .distance_m = 5e6};
    OrbitCamera crater = planet;
    crater.target = {2e6, 1e6, 0.0};
    crater.distance_m = 2e4;
    const CameraPath path = CameraPath::throughCameras({planet, crater}, FlightPace::Constant);
    for (int i = 0; i <= 1000; ++i) {
        const OrbitCamera camera = path.at(i / 1000.0);
        EXPECT_LT(length(crater.target - camera.target), 2.0 * camera.distance_m) << i;
    }
}

// Length per time, measured with the weights of the header's measure: a pan by the distance counts
// √2, a zoom by e 1/√2, a radian 0.7.
TEST(CameraPath, ConstantPaceChangesThePictureEvenly)
{
    Random random;
    for (int i = 0; i < 50; ++i) {
        const CameraPath path = CameraPath::throughCameras({anyCamera(random), anyCamera(random)},
                                                           FlightPace::Constant);
        std::vector<double> speeds;
        constexpr int kSteps = 2000;
        for (int k = 0; k < kSteps; ++k) {
            const Change change = changeBetween(path.at(static_cast<double>(k) / kSteps),
                                                path.at(static_cast<double>(k + 1) / kSteps));
            speeds.push_back(std::sqrt(
                2.0 * (change[0] * change[0] + change[1] * change[1] + change[2] * change[2]) +
                0.5 * change[3] * change[3] +
                0.49 * (change[4] * change[4] + change[5] * change[5])));
        }
        const auto [slowest, fastest] = std::minmax_element(speeds.begin(), speeds.end());
        EXPECT_LT(*fastest / *slowest, 1.1);
        double length = 0.0;
        for (const double speed : speeds) {
            length += speed;
        }
        EXPECT_NEAR(path.length() / length, 1.0, 0.03);
    }
}

TEST(CameraPath, SlowPaceRestsAtEveryView)
{
    Random random;
    const std::vector<OrbitCamera> cameras{anyCamera(random), anyCamera(random), anyCamera(random)};
    const CameraPath path = CameraPath::throughCameras(cameras, FlightPace::SlowAtViews);
    const double stop = path.stops()[1];
    constexpr double kStep = 1e-5;
    const double at_stop =
        changeSize(changeBetween(path.at(stop - kStep / 2.0), path.at(stop + kStep / 2.0)));
    const double between =
        changeSize(changeBetween(path.at(stop / 2.0), path.at(stop / 2.0 + kStep)));
    EXPECT_LT(at_stop, 1e-3 * between);
}

TEST(CameraPath, OneOrEqualCamerasStandStill)
{
    Random random;
    const OrbitCamera camera = anyCamera(random);
    for (const std::size_t count : {1U, 2U, 5U}) {
        const CameraPath path = CameraPath::throughCameras(std::vector<OrbitCamera>(count, camera),
                                                           FlightPace::SlowAtViews);
        EXPECT_EQ(path.stops().size(), count);
        for (const double share : {-1.0, 0.0, 0.4, 1.0, 2.0}) {
            EXPECT_LT(changeSize(changeBetween(camera, path.at(share))), 1e-12);
        }
    }
}

TEST(CameraPath, TurnsTheShorterWay)
{
    OrbitCamera from{.target = {}, .distance_m = 1e3, .azimuth = Angle::degrees(170.0)};
    OrbitCamera to = from;
    to.azimuth = Angle::degrees(-170.0);
    const CameraPath path = CameraPath::throughCameras({from, to}, FlightPace::Constant);
    for (int i = 0; i <= 100; ++i) {
        EXPECT_GE(std::abs(path.at(i / 100.0).azimuth.degrees()), 170.0 - 1e-9);
    }
}

TEST(CameraPath, NeverGoesBelowTheGround)
{
    Random random;
    double lowest = 1.0;
    int raised_count = 0;
    for (int i = 0; i < 40; ++i) {
        std::vector<OrbitCamera> cameras;
        for (int k = 0; k < 4; ++k) {
            OrbitCamera camera{
                .target = {random.uniform(-3e5, 3e5), random.uniform(-3e5, 3e5), 0.0},
                .distance_m = random.uniform(5e3, 4e4),
                .azimuth = Angle::degrees(random.uniform(-180.0, 180.0)),
                .tilt = Angle::degrees(random.uniform(60.0, 84.0))};
            camera.target.z = cliffs(camera.target.x, camera.target.y);
            cameras.push_back(camera);
        }
        const CameraPath low = CameraPath::throughCameras(cameras, FlightPace::SlowAtViews);
        const CameraPath path = low.above(cliffs);
        for (int k = 0; k <= 20000; ++k) {
            const double share = k / 20000.0;
            const OrbitCamera camera = path.at(share);
            const ScenePoint eye = eyeOf(camera);
            lowest = std::min(lowest, (eye.z - cliffs(eye.x, eye.y)) / camera.distance_m);
            raised_count += eye.z > eyeOf(low.at(share)).z ? 1 : 0;
            EXPECT_GE(camera.target.z, low.at(share).target.z - 1e-9);
        }
        EXPECT_LT(largestJump(path, manyShares(path, random)), 0.01);
    }
    // Between two probes a cliff may stand a little nearer.
    EXPECT_GT(lowest, 0.0);
    EXPECT_GT(raised_count, 1000);
}

TEST(CameraPath, StaysAsItIsHighAboveTheGroundOrWithoutAny)
{
    Random random;
    const CameraPath path =
        CameraPath::throughCameras({anyCamera(random), anyCamera(random)}, FlightPace::Constant);
    for (const double level : {-1e9, std::nan("")}) {
        const CameraPath above = path.above([level](double, double) { return level; });
        for (int i = 0; i <= 100; ++i) {
            EXPECT_EQ(above.at(i / 100.0), path.at(i / 100.0));
        }
    }
}

TEST(CameraPath, FollowsALineWithConstantSpeed)
{
    const std::vector<ScenePoint> line{{0.0, 0.0, 100.0}, {3e4, 4e4, 100.0}, {3e4, 9e4, 100.0}};
    const LineFlight flight{.distance_m = 4e3, .tilt = Angle::degrees(60.0)};
    const CameraPath path = CameraPath::alongLine(line, flight);
    EXPECT_NEAR(length(path.at(0.0).target - line.front()), 0.0, 1e-6);
    EXPECT_NEAR(length(path.at(1.0).target - line.back()), 0.0, 1e-6);
    EXPECT_NEAR(path.at(0.05).azimuth.degrees(), std::atan2(3.0, 4.0) * 180.0 / std::numbers::pi,
                1e-6);
    EXPECT_NEAR(path.at(0.95).azimuth.degrees(), 0.0, 1e-6);
    double slowest_m = 1e9;
    double fastest_m = 0.0;
    for (int i = 0; i < 1000; ++i) {
        const OrbitCamera camera = path.at(i / 1000.0);
        const double step_m = length(path.at((i + 1) / 1000.0).target - camera.target);
        slowest_m = std::min(slowest_m, step_m);
        fastest_m = std::max(fastest_m, step_m);
        EXPECT_NEAR(camera.distance_m, 4e3, 1e-6);
        EXPECT_NEAR(camera.tilt.degrees(), 60.0, 1e-9);
        // Never far from the line: corners are rounded over half the distance.
        const double t = std::clamp(camera.target.y / 4e4, 0.0, 1.0);
        EXPECT_NEAR(camera.target.x, 3e4 * t, 1e3);
    }
    EXPECT_LT(fastest_m / slowest_m, 1.05);
    Random random;
    EXPECT_LT(largestJump(path, manyShares(path, random)), 0.01);
}

TEST(CameraPath, FollowsLinesOfAnyLength)
{
    for (const double length_m : {1e-3, 1.0, 1e7}) {
        const CameraPath path =
            CameraPath::alongLine({{0.0, 0.0, 0.0}, {length_m, 0.0, 0.0}}, {.distance_m = 1e3});
        EXPECT_NEAR(path.at(0.5).target.x, length_m / 2.0, 1e-3 * length_m);
        EXPECT_NEAR(path.at(0.5).azimuth.degrees(), 90.0, 1e-6);
        EXPECT_NEAR(path.at(1.0).target.x, length_m, 1e-9 * length_m);
    }
}

} // namespace marsview
