#include "core/session/saved_view.h"
#include "core/session/session.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace marsview {
namespace {

using test::Random;

struct PlacedRaster {
    const char* name;
    const char* crs;
    GeoTransform::Terms terms;
};

// Rasters of 2000 × 1600 samples on several bodies, in several projections, one of them rotated.
const std::vector<PlacedRaster>& placedRasters()
{
    static const std::vector<PlacedRaster> all{
        {"Mars, degrees", "IAU_2015:49900", {-180.0, 0.18, 0.0, 90.0, 0.0, -0.1125}},
        {"Moon, south pole",
         "+proj=stere +lat_0=-90 +lon_0=0 +R=1737400 +units=m",
         {-200000.0, 200.0, 0.0, 160000.0, 0.0, -200.0}},
        {"Moon, crop", "IAU_2015:30110", {300000.0, 118.0, 0.0, -200000.0, 0.0, -118.0}},
        {"Earth, UTM", "EPSG:32611", {500000.0, 30.0, 0.0, 4000000.0, 0.0, -30.0}},
        {"Earth, rotated", "EPSG:32633", {500000.0, 20.0, 10.0, 5000000.0, 10.0, -20.0}},
    };
    return all;
}

Georeference placementOf(const PlacedRaster& one)
{
    auto crs = Crs::fromText(one.crs);
    EXPECT_TRUE(crs) << one.name;
    return {2000, 1600, *GeoTransform::fromTerms(one.terms), std::move(*crs)};
}

OrbitCamera randomViewOf(const Georeference& georeference, Random& random)
{
    const GridPoint grid{random.uniform(0.0, 1999.0), random.uniform(0.0, 1599.0)};
    return {.target = georeference.sceneFrame().toScene(grid, random.uniform(-9000.0, 9000.0)),
            .distance_m = std::pow(10.0, random.uniform(1.0, 7.0)),
            .azimuth = Angle::degrees(random.uniform(-180.0, 180.0)),
            .tilt = Angle::degrees(random.uniform(0.0, 85.0)),
            .field_of_view = Angle::degrees(40.0)};
}

double degreesApart(Angle a, Angle b)
{
    return std::abs(std::remainder((a - b).degrees(), 360.0));
}

} // namespace

TEST(ViewCamera, IsTheSameCameraAfterReturningToItsMap)
{
    Random random;
    for (const PlacedRaster& one : placedRasters()) {
        const Georeference georeference = placementOf(one);
        const double pixel_m = georeference.pixelWidthMeters();
        for (int i = 0; i < 300; ++i) {
            const OrbitCamera camera = randomViewOf(georeference, random);
            const double exaggeration = random.uniform(0.5, 20.0);
            const auto view = viewCamera(georeference, camera, exaggeration);
            ASSERT_TRUE(view) << one.name;
            const auto again = orbitCamera(georeference, *view, exaggeration);
            ASSERT_TRUE(again) << one.name;
            EXPECT_NEAR(again->target.x, camera.target.x, 1e-4 * pixel_m) << one.name;
            EXPECT_NEAR(again->target.y, camera.target.y, 1e-4 * pixel_m) << one.name;
            EXPECT_NEAR(again->target.z, camera.target.z, 1e-8) << one.name;
            EXPECT_EQ(again->distance_m, camera.distance_m);
            EXPECT_LT(degreesApart(again->azimuth, camera.azimuth), 2e-6) << one.name;
            EXPECT_NEAR(again->tilt.degrees(), camera.tilt.degrees(), 1e-6);
            EXPECT_EQ(view->field_of_view, camera.field_of_view);
            // What was saved once stays as it is.
            const auto saved_again = viewCamera(georeference, *again, exaggeration);
            ASSERT_TRUE(saved_again);
            EXPECT_LT(degreesApart(saved_again->azimuth, view->azimuth), 2e-6) << one.name;
        }
    }
}

// In a polar stereographic map of the south pole, the meridian of longitude λ runs outwards from
// the pole at the angle λ, clockwise from the map's y axis: north is there.
TEST(ViewCamera, AzimuthIsFromTrueNorthWhereverTheMapPoints)
{
    const Georeference georeference = placementOf(placedRasters()[1]);
    for (const double longitude_deg : {0.0, 30.0, 90.0, -135.0, 179.0}) {
        const double angle = longitude_deg * std::numbers::pi / 180.0;
        const GridPoint grid =
            georeference.toGrid(MapPoint{1e5 * std::sin(angle), 1e5 * std::cos(angle)});
        const OrbitCamera camera{.target = georeference.sceneFrame().toScene(grid, 0.0),
                                 .distance_m = 1000.0,
                                 .azimuth = Angle::degrees(12.0)};
        const auto view = viewCamera(georeference, camera, 1.0);
        ASSERT_TRUE(view);
        EXPECT_LT(degreesApart(view->azimuth, Angle::degrees(12.0 - longitude_deg)), 1e-4)
            << longitude_deg;
    }
}

// The same place from the same side, on two maps of the Moon in different projections.
TEST(ViewCamera, LooksAtTheSamePlaceOnAnotherMapOfTheBody)
{
    const Georeference polar = placementOf(placedRasters()[1]);
    auto crs = Crs::fromText("IAU_2015:30100");
    ASSERT_TRUE(crs);
    const Georeference global(2000, 1600,
                              *GeoTransform::fromTerms({-180.0, 0.18, 0.0, 90.0, 0.0, -0.1125}),
                              std::move(*crs));
    const OrbitCamera camera{.target = polar.sceneFrame().toScene({1300.0, 500.0}, 600.0),
                             .distance_m = 5e4,
                             .azimuth = Angle::degrees(70.0),
                             .tilt = Angle::degrees(40.0)};
    const auto view = viewCamera(polar, camera, 3.0);
    ASSERT_TRUE(view);
    EXPECT_NEAR(view->elevation_m, 200.0, 1e-9);
    const auto there = orbitCamera(global, *view, 2.0);
    ASSERT_TRUE(there);
    EXPECT_NEAR(there->target.z, 400.0, 1e-9);
    const auto place = global.toGeographic(global.sceneFrame().toGrid(there->target));
    const auto truth = polar.toGeographic(polar.sceneFrame().toGrid(camera.target));
    ASSERT_TRUE(place && truth);
    EXPECT_NEAR(place->latitude.degrees(), truth->latitude.degrees(), 1e-8);
    EXPECT_LT(degreesApart(place->longitude, truth->longitude), 1e-8);
    EXPECT_LT(degreesApart(there->azimuth, view->azimuth), 1e-5); // this map's y axis is north
}

TEST(ViewCamera, AMapWithoutABodyKeepsMapCoordinates)
{
    const Georeference local(100, 100, *GeoTransform::fromTerms({10.0, 2.0, 0.0, 50.0, 0.0, -2.0}),
                             std::nullopt);
    const OrbitCamera camera{.target = local.sceneFrame().toScene({20.0, 30.0}, 7.0),
                             .distance_m = 40.0};
    const auto view = viewCamera(local, camera, 1.0);
    ASSERT_TRUE(view);
    ASSERT_TRUE(std::holds_alternative<MapPoint>(view->target));
    EXPECT_EQ(std::get<MapPoint>(view->target), local.toMap({20.0, 30.0}));
    const auto again = orbitCamera(local, *view, 1.0);
    ASSERT_TRUE(again);
    EXPECT_NEAR(again->target.x, camera.target.x, 1e-9);
    EXPECT_FALSE(orbitCamera(placementOf(placedRasters()[0]), *view, 1.0));
    const auto on_mars =
        viewCamera(placementOf(placedRasters()[0]), {.target = {}, .distance_m = 1.0}, 1.0);
    ASSERT_TRUE(on_mars);
    EXPECT_FALSE(orbitCamera(local, *on_mars, 1.0));
}

TEST(SessionViews, KeepTheirOrderAndNeverReuseAnId)
{
    Session session;
    for (const char* name : {"a", "b", "c"}) {
        session = withView(session, {.name = name});
    }
    const ViewId first = session.views[0].id;
    const ViewId last = session.views[2].id;
    const auto names = [](const Session& one) {
        std::string text;
        for (const SavedView& view : one.views) {
            text += view.name;
        }
        return text;
    };
    EXPECT_EQ(names(movedView(session, first, 1)), "bac");
    EXPECT_EQ(names(movedView(session, first, 99)), "bca");
    EXPECT_EQ(names(movedView(session, last, 0)), "cab");
    EXPECT_EQ(names(movedView(session, ViewId{77}, 0)), "abc");

    SavedView renamed = *viewOf(session, first);
    renamed.name = "x";
    EXPECT_EQ(names(withView(session, renamed)), "xbc");
    const Session without = withoutView(session, last);
    EXPECT_EQ(names(without), "ab");
    EXPECT_EQ(withoutView(without, last), without);
    EXPECT_EQ(viewOf(without, last), nullptr);
    const Session with = withView(without, {.name = "d"});
    EXPECT_NE(with.views.back().id, last);
    EXPECT_GT(with.views.back().id, last);
}

} // namespace marsview
