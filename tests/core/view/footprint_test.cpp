#include "core/view/footprint.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>

namespace marsview {
namespace {

const MapPlan kNorthUp{.frame = {.origin = {49.5, 29.5},
                                 .east_per_column = 100.0,
                                 .east_per_row = 0.0,
                                 .north_per_column = 0.0,
                                 .north_per_row = -100.0},
                       .columns = 100,
                       .rows = 60};

// Rotated, sheared, mirrored or upside down.
MapPlan randomMap(test::Random& random)
{
    MapPlan map;
    map.columns = 2 + random.below(200);
    map.rows = 2 + random.below(200);
    const double pixel_m = std::pow(10.0, random.uniform(-1.0, 4.0));
    const double turn = random.uniform(-3.2, 3.2);
    const double sign = random.chance(0.5) ? 1.0 : -1.0;
    const double shear = random.uniform(-0.3, 0.3);
    map.frame = {.origin = {0.5 * static_cast<double>(map.columns - 1),
                            0.5 * static_cast<double>(map.rows - 1)},
                 .east_per_column = pixel_m * std::cos(turn),
                 .east_per_row = pixel_m * (std::sin(turn) + shear),
                 .north_per_column = pixel_m * std::sin(turn) * sign,
                 .north_per_row = -pixel_m * std::cos(turn) * sign};
    if (std::abs(map.frame.east_per_column * map.frame.north_per_row -
                 map.frame.east_per_row * map.frame.north_per_column) < 0.1 * pixel_m * pixel_m) {
        map.frame.east_per_column = pixel_m;
        map.frame.east_per_row = 0.0;
        map.frame.north_per_column = 0.0;
        map.frame.north_per_row = -pixel_m;
    }
    return map;
}

double sizeOf(const MapPlan& map)
{
    const ScenePoint a = map.frame.toScene({0.0, 0.0}, 0.0);
    const ScenePoint b = map.frame.toScene(
        {static_cast<double>(map.columns - 1), static_cast<double>(map.rows - 1)}, 0.0);
    return length(a - b);
}

OrbitCamera randomCamera(test::Random& random, const MapPlan& map)
{
    const double size_m = sizeOf(map);
    OrbitCamera camera;
    camera.target = {random.uniform(-0.5, 0.5) * size_m, random.uniform(-0.5, 0.5) * size_m,
                     random.uniform(-0.2, 0.2) * size_m};
    camera.distance_m = size_m * std::pow(10.0, random.uniform(-2.0, 1.0));
    camera.azimuth = Angle::degrees(random.uniform(-180.0, 180.0));
    camera.tilt = Angle::degrees(random.chance(0.2) ? 0.0 : random.uniform(0.0, 85.0));
    if (random.chance(0.2)) {
        camera.tilt = Angle::degrees(85.0);
    }
    return camera;
}

Viewport randomViewport(test::Random& random)
{
    constexpr std::array kSome{Viewport{1280, 800}, Viewport{300, 900}, Viewport{1, 1},
                               Viewport{8000, 4000}, Viewport{2000, 20}};
    return kSome[random.below(kSome.size())];
}

// The distance of a point outside a convex polygon, in samples; negative inside.
double outside(const std::vector<GridPoint>& polygon, GridPoint p)
{
    double turn = 0.0;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        turn += (polygon[i - 1].column - polygon[0].column) * (polygon[i].row - polygon[0].row) -
                (polygon[i].column - polygon[0].column) * (polygon[i - 1].row - polygon[0].row);
    }
    double furthest = -1e30;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const GridPoint& a = polygon[i];
        const GridPoint& b = polygon[(i + 1) % polygon.size()];
        const double side = std::hypot(b.column - a.column, b.row - a.row);
        if (side > 0.0) {
            const double cross =
                (b.column - a.column) * (p.row - a.row) - (b.row - a.row) * (p.column - a.column);
            furthest = std::max(furthest, -cross / side * (turn > 0.0 ? 1.0 : -1.0));
        }
    }
    return furthest;
}

TEST(Footprint, ContainsExactlyThePointsThatProjectIntoThePicture)
{
    test::Random random;
    int inside_count = 0;
    int outside_count = 0;
    int undecided_count = 0;
    for (int i = 0; i < 3000; ++i) {
        const MapPlan map = randomMap(random);
        const OrbitCamera camera = randomCamera(random, map);
        const Viewport viewport = randomViewport(random);
        const std::vector<GridPoint> polygon = footprint(camera, viewport, map);
        const double samples = static_cast<double>(map.columns + map.rows);
        for (int k = 0; k < 30; ++k) {
            GridPoint p{random.uniform(0.0, static_cast<double>(map.columns - 1)),
                        random.uniform(0.0, static_cast<double>(map.rows - 1))};
            if (k < 15 && !polygon.empty()) { // also where it matters
                p = polygon[random.below(polygon.size())];
                p.column += random.uniform(-0.02, 0.02) * samples;
                p.row += random.uniform(-0.02, 0.02) * samples;
                if (p.column < 0.0 || p.column > static_cast<double>(map.columns - 1) ||
                    p.row < 0.0 || p.row > static_cast<double>(map.rows - 1)) {
                    continue;
                }
            }
            const auto pixel = project(camera, viewport, map.frame.toScene(p, camera.target.z));
            const bool is_seen = pixel && pixel->x >= 0.0 && pixel->x <= viewport.width &&
                                 pixel->y >= 0.0 && pixel->y <= viewport.height;
            const double beyond = polygon.empty() ? 1.0 : outside(polygon, p);
            if (std::abs(beyond) < 1e-9 * samples) {
                ++undecided_count;
                continue;
            }
            ASSERT_EQ(is_seen, beyond < 0.0)
                << "by " << beyond << " samples, tilt " << camera.tilt.degrees();
            ++(is_seen ? inside_count : outside_count);
        }
    }
    std::cout << inside_count << " inside, " << outside_count << " outside, " << undecided_count
              << " on the boundary\n";
    EXPECT_GT(inside_count, 5000);
    EXPECT_GT(outside_count, 5000);
    EXPECT_LT(undecided_count, 100);
}

TEST(Footprint, HasItsCornersOnTheEdgeOfPictureOrMap)
{
    test::Random random;
    for (int i = 0; i < 5000; ++i) {
        const MapPlan map = randomMap(random);
        const OrbitCamera camera = randomCamera(random, map);
        const Viewport viewport = randomViewport(random);
        const double last_column = static_cast<double>(map.columns - 1);
        const double last_row = static_cast<double>(map.rows - 1);
        const std::vector<GridPoint> polygon = footprint(camera, viewport, map);
        ASSERT_LE(polygon.size(), 8U);
        for (const GridPoint& p : polygon) {
            const double from_edge =
                std::min({p.column, last_column - p.column, p.row, last_row - p.row});
            ASSERT_GE(from_edge, -1e-9 * (last_column + last_row));
            const auto pixel = project(camera, viewport, map.frame.toScene(p, camera.target.z));
            ASSERT_TRUE(pixel);
            const double x = pixel->x / viewport.width;
            const double y = pixel->y / viewport.height;
            const double from_rim = std::min({x, 1.0 - x, y, 1.0 - y});
            ASSERT_GE(from_rim, -1e-6);
            ASSERT_TRUE(from_edge < 1e-6 || from_rim < 1e-6) << from_edge << ' ' << from_rim;
        }
    }
}

TEST(Footprint, IsTheRectangleOfThePictureStraightDown)
{
    const OrbitCamera camera{.distance_m = 1000.0};
    const std::vector<GridPoint> polygon = footprint(camera, {200, 100}, kNorthUp);
    ASSERT_EQ(polygon.size(), 4U);
    const double half_height = 10.0 * std::tan(Angle::degrees(20.0).radians()); // in samples
    for (const GridPoint& p : polygon) {
        EXPECT_NEAR(std::abs(p.column - 49.5), 2.0 * half_height, 1e-9);
        EXPECT_NEAR(std::abs(p.row - 29.5), half_height, 1e-9);
    }
    EXPECT_NEAR(shareOfMap(polygon, kNorthUp), 8.0 * half_height * half_height / (99.0 * 59.0),
                1e-12);
}

TEST(Footprint, IsTheWholeMapForADistantCamera)
{
    const std::vector<GridPoint> polygon = footprint({.distance_m = 1e6}, {1280, 800}, kNorthUp);
    EXPECT_EQ(polygon.size(), 4U);
    EXPECT_DOUBLE_EQ(shareOfMap(polygon, kNorthUp), 1.0);
}

TEST(Footprint, ReachesTheEdgeOfTheMapBelowTheHorizon)
{
    const OrbitCamera camera{
        .target = {0.0, -2000.0, 0.0}, .distance_m = 500.0, .tilt = Angle::degrees(85.0)};
    const Viewport viewport{1280, 800};
    ASSERT_GT(pickRay(camera, viewport, {0.0, 0.0}).direction.z, 0.0) << "the sky is in the view";
    double north_row = 1e9;
    for (const GridPoint& p : footprint(camera, viewport, kNorthUp)) {
        north_row = std::min(north_row, p.row);
    }
    EXPECT_EQ(north_row, 0.0);
}

TEST(Footprint, IsEmptyWhenTheMapIsBehind)
{
    const OrbitCamera camera{
        .target = {0.0, 9000.0, 0.0}, .distance_m = 500.0, .tilt = Angle::degrees(70.0)};
    EXPECT_TRUE(footprint(camera, {1280, 800}, kNorthUp).empty());
    EXPECT_EQ(shareOfMap({}, kNorthUp), 0.0);
}

TEST(Footprint, WorksOnTheSmallestMapAndWindow)
{
    const MapPlan map{.frame = {.origin = {0.5, 0.5}}, .columns = 2, .rows = 2};
    const OrbitCamera camera{.distance_m = 10.0};
    EXPECT_EQ(footprint(camera, {1, 1}, map).size(), 4U);
    EXPECT_DOUBLE_EQ(shareOfMap(footprint(camera, {1, 1}, map), map), 1.0);
    EXPECT_TRUE(footprint({.target = {std::nan(""), 0.0, 0.0}}, {1, 1}, map).empty());
}

TEST(CameraWedge, LeadsFromTheEyeToThePointsBesideTheTarget)
{
    test::Random random;
    for (int i = 0; i < 2000; ++i) {
        const MapPlan map = randomMap(random);
        const OrbitCamera camera = randomCamera(random, map);
        const Viewport viewport{1280, 800};
        const CameraWedge wedge = cameraWedge(camera, viewport, map.frame);
        const ScenePoint eye = map.frame.toScene(wedge.eye, eyeOf(camera).z);
        const double tolerance = 1e-9 * (camera.distance_m + sizeOf(map));
        ASSERT_LT(length(eye - eyeOf(camera)), tolerance);
        ASSERT_NEAR(length(wedge.left), 1.0, 1e-12);
        ASSERT_NEAR(length(wedge.right), 1.0, 1e-12);
        for (const bool is_left : {true, false}) {
            ScenePoint end = eye + (is_left ? wedge.left : wedge.right) * wedge.length_m;
            end.z = camera.target.z;
            const auto pixel = project(camera, viewport, end);
            ASSERT_TRUE(pixel);
            ASSERT_NEAR(pixel->x, is_left ? 0.0 : viewport.width, 1e-3);
            ASSERT_NEAR(pixel->y, viewport.height / 2.0, 1e-3);
        }
    }
}

TEST(CameraWedge, OpensToBothSidesStraightDown)
{
    const CameraWedge wedge = cameraWedge({.distance_m = 10.0}, {4, 3}, kNorthUp.frame);
    EXPECT_EQ(wedge.left, (Vec3{-1.0, 0.0, 0.0}));
    EXPECT_EQ(wedge.right, (Vec3{1.0, 0.0, 0.0}));
    EXPECT_EQ(wedge.eye, (GridPoint{49.5, 29.5}));
}

} // namespace
} // namespace marsview
