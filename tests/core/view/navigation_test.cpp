#include "core/view/navigation.h"
#include "tests/core/view/some_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace marsview {
namespace {

using test::someCamera;

constexpr Viewport kViewport{1000, 600};
const SceneBox kBox{{-1e5, -5e4, -2e3}, {1e5, 5e4, 6e3}};

double flatGround(double /*east_m*/, double /*north_m*/)
{
    return 0.0;
}

TEST(HomeCamera, ShowsTheWholeBoxFromTheSouth)
{
    for (const Viewport viewport : {Viewport{1600, 400}, Viewport{300, 900}, kViewport}) {
        const OrbitCamera camera = homeCamera(kBox, viewport);
        EXPECT_EQ(camera.azimuth, Angle{});
        EXPECT_LT(eyeOf(camera).y, kBox.center().y);
        double widest = 0.0;
        for (const ScenePoint& corner : kBox.corners()) {
            const auto pixel = project(camera, viewport, corner);
            ASSERT_TRUE(pixel);
            EXPECT_GE(pixel->x, 0.0);
            EXPECT_LE(pixel->x, viewport.width);
            EXPECT_GE(pixel->y, 0.0);
            EXPECT_LE(pixel->y, viewport.height);
            widest = std::max({widest, std::abs(pixel->x / viewport.width - 0.5),
                               std::abs(pixel->y / viewport.height - 0.5)});
        }
        EXPECT_GT(widest, 0.4) << "the map fills the view in one direction";
    }
}

TEST(HomeCamera, ShowsTheWholeBoxFromEveryDirection)
{
    for (const double azimuth_deg : {0.0, 37.0, 90.0, 160.0, 180.0, -120.0}) {
        for (const double tilt_deg : {0.0, 20.0, 60.0, 85.0}) {
            const ViewDirection from{.azimuth = Angle::degrees(azimuth_deg),
                                     .tilt = Angle::degrees(tilt_deg)};
            const OrbitCamera camera = homeCamera(kBox, kViewport, from);
            EXPECT_EQ(camera.azimuth, from.azimuth);
            EXPECT_EQ(camera.tilt, from.tilt);
            double widest = 0.0;
            for (const ScenePoint& corner : kBox.corners()) {
                const auto pixel = project(camera, kViewport, corner);
                ASSERT_TRUE(pixel);
                widest = std::max({widest, std::abs(pixel->x / kViewport.width - 0.5),
                                   std::abs(pixel->y / kViewport.height - 0.5)});
            }
            EXPECT_GT(widest, 0.4) << azimuth_deg << "°, " << tilt_deg << "°";
            EXPECT_LE(widest, 0.5) << azimuth_deg << "°, " << tilt_deg << "°";
        }
    }
}

// The box of `picture`, as shares of its sides, in which the boxes appear.
struct Covered {
    double width = 0.0;
    double height = 0.0;
    bool is_inside = true;
};

Covered
covered(const std::vector<SceneBox>& boxes, const OrbitCamera& camera, const Viewport& picture)
{
    double left = HUGE_VAL;
    double right = -HUGE_VAL;
    double top = HUGE_VAL;
    double bottom = -HUGE_VAL;
    for (const SceneBox& box : boxes) {
        for (const ScenePoint& corner : box.corners()) {
            const auto pixel = project(camera, picture, corner);
            if (!pixel) {
                return {.is_inside = false};
            }
            left = std::min(left, pixel->x / picture.width);
            right = std::max(right, pixel->x / picture.width);
            top = std::min(top, pixel->y / picture.height);
            bottom = std::max(bottom, pixel->y / picture.height);
        }
    }
    return {.width = right - left,
            .height = bottom - top,
            .is_inside = left >= 0.0 && right <= 1.0 && top >= 0.0 && bottom <= 1.0};
}

TEST(FillingCamera, AWholeBodyTakesMoreOfThePictureThanAtTheUsualTilt)
{
    const std::vector<SceneBox> body{{{-1e7, -5e6, -8e3}, {1e7, 5e6, 21e3}}};
    constexpr Viewport kView{852, 694}; // of a window of 1280 × 800
    const Covered usual = covered(body, homeCamera(body.front(), kView), kView);
    const Covered filled = covered(body, fillingCamera(body, kView), kView);
    EXPECT_TRUE(filled.is_inside);
    EXPECT_GT(filled.width, 0.95);
    EXPECT_GT(filled.height, 0.5);
    EXPECT_LT(usual.height, 0.4);
}

TEST(FillingCamera, FillsThePictureInBothDirectionsWhereATiltDoes)
{
    const std::vector<SceneBox> tile{{{-4e4, -5.5e4, 0.0}, {4e4, 5.5e4, 2e3}}};
    for (const Viewport view : {Viewport{700, 700}, Viewport{800, 700}}) {
        const Covered filled = covered(tile, fillingCamera(tile, view), view);
        EXPECT_TRUE(filled.is_inside);
        EXPECT_GT(filled.width, 0.9) << view.width;
        EXPECT_GT(filled.height, 0.9) << view.width;
    }
}

// A ridge in the middle of a plain: no corner of the box around all is on the terrain.
TEST(FillingCamera, RoomAroundTheTerrainIsNotKeptForABoxAroundIt)
{
    const std::vector<SceneBox> parts{{{-1e5, -1e5, 0.0}, {-1e4, 1e5, 1e2}},
                                      {{-1e4, -1e4, 0.0}, {1e4, 1e4, 8e4}},
                                      {{1e4, -1e5, 0.0}, {1e5, 1e5, 1e2}}};
    const SceneBox around = united(united(parts[0], parts[1]), parts[2]);
    const Covered by_box = covered(parts, homeCamera(around, kViewport), kViewport);
    const Covered by_parts = covered(parts, fillingCamera(parts, kViewport), kViewport);
    EXPECT_TRUE(by_parts.is_inside);
    EXPECT_GT(by_parts.height, 0.9);
    EXPECT_LT(by_box.height, 0.8);
}

// Of other bodies than Mars, which has a view of its own; whole bodies, and a belt.
TEST(OpeningCamera, AMapAroundItsBodyFillsThePictureObliquely)
{
    struct Whole {
        const char* crs;
        std::size_t columns;
        std::size_t rows;
        GeoTransform::Terms terms;
    };
    constexpr const char* kEquirectangular = "+proj=eqc +R=1737400 +units=m";
    for (const Whole& map : {Whole{"IAU_2015:30100", 1440, 720, {0, 0.25, 0, 90, 0, -0.25}},
                             {"EPSG:4326", 360, 180, {-180, 1, 0, 90, 0, -1}},
                             {"IAU_2015:30100", 360, 60, {0, 1, 0, 30, 0, -1}},
                             {kEquirectangular,
                              1440,
                              720,
                              {-5458203.08, 7580.83761, 0, 2729101.54, 0, -7580.83761}}}) {
        const Georeference georeference(map.columns, map.rows, *GeoTransform::fromTerms(map.terms),
                                        *Crs::fromText(map.crs));
        const auto camera = openingCamera(georeference);
        ASSERT_TRUE(camera) << map.crs;
        EXPECT_GT(camera->tilt.degrees(), 45.0);
        for (const Viewport viewport : {kViewport, Viewport{1600, 800}, Viewport{900, 900}}) {
            const double right = viewport.width;
            const double bottom = viewport.height;
            for (const PixelPoint corner :
                 {PixelPoint{0.0, 0.0}, {right, 0.0}, {0.0, bottom}, {right, bottom}}) {
                const Ray ray = pickRay(*camera, viewport, corner);
                ASSERT_LT(ray.direction.z, 0.0);
                const GridPoint grid =
                    georeference.sceneFrame().toGrid(ray.at(-ray.origin.z / ray.direction.z));
                EXPECT_GE(grid.column, 0.0) << map.crs;
                EXPECT_LE(grid.column, static_cast<double>(map.columns - 1)) << map.crs;
                EXPECT_GE(grid.row, 0.0) << map.crs;
                EXPECT_LE(grid.row, static_cast<double>(map.rows - 1)) << map.crs;
            }
        }
    }
    const Georeference part(60, 50, *GeoTransform::fromTerms({130, 0.01, 0, -4.5, 0, -0.01}),
                            *Crs::fromText("IAU_2015:30100"));
    EXPECT_FALSE(openingCamera(part)) << "it is shown whole";
}

TEST(Zoomed, KeepsTheAnchorFixed)
{
    const NavigationLimits limits = navigationLimits(kBox, 30.0);
    const ScenePoint anchor{5e4, 3e4, 1200.0};
    const OrbitCamera before = someCamera();
    const auto pixel = project(before, kViewport, anchor);
    for (const double factor : {0.9, 0.5, 0.01, 1.7}) {
        const auto after = project(zoomed(before, factor, anchor, limits), kViewport, anchor);
        ASSERT_TRUE(pixel && after);
        EXPECT_NEAR(after->x, pixel->x, 1e-6);
        EXPECT_NEAR(after->y, pixel->y, 1e-6);
    }
}

TEST(Zoomed, StopsAtTheLimits)
{
    const NavigationLimits limits = navigationLimits(kBox, 30.0);
    const OrbitCamera camera = someCamera();
    EXPECT_EQ(zoomed(camera, 1e-12, camera.target, limits).distance_m, limits.distance_min_m);
    EXPECT_EQ(zoomed(camera, 1e12, camera.target, limits).distance_m, limits.distance_max_m);
}

TEST(Zoomed, ZoomingOutOverTheSkyMultipliesTheDistance)
{
    const NavigationLimits limits = navigationLimits(kBox, 30.0);
    OrbitCamera camera =
        constrained({.target = {0.0, 4e4, 0.0}, .distance_m = 500.0, .tilt = Angle::degrees(85.0)},
                    limits, flatGround);
    double distance_m = camera.distance_m;
    for (int i = 0; i < 60; ++i) {
        const Ray ray = pickRay(camera, kViewport, {700.0, 20.0});
        ASSERT_GT(ray.direction.z, 0.0);
        camera = constrained(zoomed(camera, 1.25, anchorBesideMap(camera, ray), limits), limits,
                             flatGround);
        distance_m = std::min(distance_m * 1.25, limits.distance_max_m);
        ASSERT_NEAR(camera.distance_m, distance_m, 1e-9 * distance_m);
        ASSERT_NEAR(eyeOf(camera).z, distance_m * std::cos(camera.tilt.radians()),
                    1e-9 * distance_m);
    }
    EXPECT_EQ(camera.distance_m, limits.distance_max_m);
    EXPECT_NEAR(camera.tilt.degrees(), 85.0, 1e-9);
}

TEST(AnchorBesideMap, IsLevelWithTheTarget)
{
    const OrbitCamera camera = someCamera();
    const PixelPoint pixel{700.0, 400.0};
    const ScenePoint anchor = anchorBesideMap(camera, pickRay(camera, kViewport, pixel));
    EXPECT_NEAR(anchor.z, camera.target.z, 1e-6);
    const auto seen = project(camera, kViewport, anchor);
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->x, pixel.x, 1e-6);
    EXPECT_NEAR(seen->y, pixel.y, 1e-6);
}

TEST(Interpolated, KeepsTheAnchorOfAZoomFixedThroughout)
{
    const NavigationLimits limits = navigationLimits(kBox, 30.0);
    const ScenePoint anchor{5e4, 3e4, 1200.0};
    const OrbitCamera before = someCamera();
    const OrbitCamera after = zoomed(before, 0.2, anchor, limits);
    const auto pixel = project(before, kViewport, anchor);
    for (int eighth = 0; eighth <= 8; ++eighth) {
        const double t = eighth / 8.0;
        const auto between = project(interpolated(before, after, t), kViewport, anchor);
        ASSERT_TRUE(pixel && between);
        EXPECT_NEAR(between->x, pixel->x, 1e-6);
        EXPECT_NEAR(between->y, pixel->y, 1e-6);
    }
}

TEST(Interpolated, TurnsInTheShorterDirection)
{
    OrbitCamera from = someCamera();
    OrbitCamera to = from;
    from.azimuth = Angle::degrees(170.0);
    to.azimuth = Angle::degrees(-170.0);
    EXPECT_NEAR(std::abs(interpolated(from, to, 0.5).azimuth.degrees()), 180.0, 1e-9);
    EXPECT_EQ(interpolated(from, to, 0.0), from);
    EXPECT_EQ(interpolated(from, to, 1.0), to);
}

TEST(Dragged, KeepsTheGrabbedPointUnderThePointer)
{
    const OrbitCamera before = someCamera();
    const PixelPoint from{520.0, 310.0};
    const PixelPoint to{430.0, 380.0};
    const double level_m = 700.0;
    const ScenePoint grabbed = pointOnLevel(pickRay(before, kViewport, from), level_m, 1e9);
    const OrbitCamera after =
        dragged(before, kViewport, {.from = from, .to = to, .grabbed_z_m = level_m});
    const auto pixel = project(after, kViewport, grabbed);
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x, to.x, 1e-6);
    EXPECT_NEAR(pixel->y, to.y, 1e-6);
}

TEST(Dragged, IsBoundedAtTheHorizon)
{
    OrbitCamera camera = someCamera();
    camera.tilt = Angle::degrees(85.0);
    const OrbitCamera after =
        dragged(camera, kViewport, {.from = {500.0, 300.0}, .to = {500.0, 5.0}});
    EXPECT_LT(length(after.target - camera.target), 10.0 * camera.distance_m);
}

TEST(Panned, FollowsTheHeading)
{
    OrbitCamera camera = someCamera();
    camera.azimuth = Angle::degrees(90.0); // looks east
    const OrbitCamera after = panned(camera, 0.0, 0.5);
    EXPECT_NEAR(after.target.x - camera.target.x, 0.5 * camera.distance_m, 1e-6);
    EXPECT_NEAR(after.target.y, camera.target.y, 1e-6);
    EXPECT_NEAR(panned(camera, 0.5, 0.0).target.y - camera.target.y, -0.5 * camera.distance_m,
                1e-6);
}

TEST(Orbited, KeepsTheTargetAndDistance)
{
    const OrbitCamera camera = someCamera();
    const OrbitCamera after = orbited(camera, Angle::degrees(25.0), Angle::degrees(-10.0));
    EXPECT_EQ(after.target, camera.target);
    EXPECT_EQ(after.distance_m, camera.distance_m);
    EXPECT_NEAR(after.azimuth.degrees(), -15.0, 1e-9);
    EXPECT_NEAR(after.tilt.degrees(), 40.0, 1e-9);
    EXPECT_LE(orbited(camera, {}, Angle::degrees(500.0)).tilt.degrees(), 85.0 + 1e-9);
}

TEST(Retargeted, DoesNotChangeThePicture)
{
    const OrbitCamera camera = someCamera();
    const OrbitCamera after = retargeted(camera, 3.3e4);
    EXPECT_LT(length(eyeOf(after) - eyeOf(camera)), 1e-6);
    EXPECT_EQ(after.azimuth, camera.azimuth);
    EXPECT_EQ(after.tilt, camera.tilt);
}

TEST(Constrained, NeverLosesTheMap)
{
    const NavigationLimits limits = navigationLimits(kBox, 30.0);
    OrbitCamera lost = someCamera();
    lost.target = {1e9, -1e9, 1e7};
    lost.distance_m = 1e12;
    lost.tilt = Angle::degrees(120.0);
    const OrbitCamera found = constrained(lost, limits, flatGround);
    EXPECT_LE(found.target.x, kBox.maximum.x);
    EXPECT_GE(found.target.y, kBox.minimum.y);
    EXPECT_LE(found.distance_m, limits.distance_max_m);
    EXPECT_LE(found.tilt.degrees(), 85.0 + 1e-9);
}

TEST(Constrained, KeepsTheEyeAboveTheTerrain)
{
    const NavigationLimits limits = navigationLimits(kBox, 30.0);
    const auto hill = [](double east_m, double north_m) {
        return 5e3 * std::exp(-(east_m * east_m + north_m * north_m) / 1e8);
    };
    for (int heading = -180; heading < 180; heading += 15) {
        const double azimuth = heading;
        for (const double distance_m : {100.0, 1e3, 1e4, 1e5}) {
            const OrbitCamera camera = constrained({.target = {0.0, 0.0, -2e3},
                                                    .distance_m = distance_m,
                                                    .azimuth = Angle::degrees(azimuth),
                                                    .tilt = Angle::degrees(85.0)},
                                                   limits, hill);
            const ScenePoint eye = eyeOf(camera);
            EXPECT_GT(eye.z, hill(eye.x, eye.y));
        }
    }
}

// With a target in the air above the map's edge, seen along the horizon, the view had shown only
// sky around it.
TEST(Constrained, KeepsTheTerrainUnderTheTargetInThePicture)
{
    const NavigationLimits limits = navigationLimits(kBox, 30.0);
    for (int degrees = 0; degrees <= 85; degrees += 5) {
        const double tilt = degrees;
        for (const double z : {0.0, 1e3, 6e3}) {
            const OrbitCamera camera = constrained({.target = {0.0, kBox.maximum.y, z},
                                                    .distance_m = 2e3,
                                                    .tilt = Angle::degrees(tilt)},
                                                   limits, flatGround);
            const auto pixel = project(camera, kViewport, {camera.target.x, camera.target.y, 0.0});
            ASSERT_TRUE(pixel);
            EXPECT_LE(pixel->y, 0.875 * kViewport.height + 1e-6);
            EXPECT_NEAR(camera.tilt.degrees(), tilt, 1e-9);
        }
    }
}

TEST(Constrained, TiltsLessBehindARidge)
{
    const NavigationLimits limits = navigationLimits(kBox, 30.0);
    const auto ridge = [](double /*east_m*/, double north_m) {
        return 5e3 * std::exp(-north_m * north_m / 1e6);
    };
    const OrbitCamera camera =
        constrained({.target = {0.0, 4e3, 0.0}, .distance_m = 4e3, .tilt = Angle::degrees(85.0)},
                    limits, ridge);
    const ScenePoint eye = eyeOf(camera);
    EXPECT_LT(camera.tilt.degrees(), 84.0);
    EXPECT_NEAR(eye.z, ridge(eye.x, eye.y) + camera.distance_m / 50.0, 1.0);
    EXPECT_EQ(constrained(camera, limits, ridge), camera) << "allowed cameras do not change";
}

TEST(Constrained, IsNotConstrainedByHolesInTheTerrain)
{
    const NavigationLimits limits = navigationLimits(kBox, 30.0);
    const auto nothing = [](double /*east_m*/, double /*north_m*/) { return std::nan(""); };
    const OrbitCamera camera = someCamera();
    EXPECT_EQ(constrained(camera, limits, nothing), constrained(camera, limits, {}));
}

TEST(Constrained, EndsInABoxOfInfiniteSize)
{
    SceneBox box = kBox;
    box.maximum.z = 1e200; // the square of the diagonal overflows
    const NavigationLimits limits = navigationLimits(box, 30.0);
    ASSERT_TRUE(std::isinf(limits.distance_max_m));
    const auto nothing = [](double /*east_m*/, double /*north_m*/) { return std::nan(""); };
    const OrbitCamera camera = constrained(someCamera(), limits, nothing);
    EXPECT_TRUE(std::isfinite(camera.target.x) && std::isfinite(camera.target.y));
}

} // namespace
} // namespace marsview
