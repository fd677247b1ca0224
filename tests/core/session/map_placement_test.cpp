// Named features are at their gazetteer positions, through all stages: file, placement, surface.
#include "core/raster/raster_file.h"
#include "core/session/map.h"
#include "tests/support/nomenclature.h"
#include "tests/support/shared_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

namespace marsview {
namespace {

using test::marsDistance_km;
using test::NamedFeature;

std::shared_ptr<const Map> load(const std::filesystem::path& path)
{
    JobMonitor monitor;
    auto map = readMap(RasterSpec{path.string(), 1, {}}, monitor, defaultMemoryBudget());
    EXPECT_TRUE(map) << map.error().message;
    return map ? *map : nullptr;
}

struct Place {
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    double height_m = 0.0;
};

// The highest (sign +1) or lowest (-1) sample among those that `is_wanted` accepts.
template <typename F>
Place extreme(const Map& map, double sign, F&& is_wanted)
{
    Place best;
    bool is_found = false;
    const Heightfield& surface = map.heightfield();
    for (std::size_t r = 0; r < surface.rows(); ++r) {
        for (std::size_t c = 0; c < surface.columns(); ++c) {
            const double height = surface.sample(c, r);
            if (!(height * sign > best.height_m * sign) && is_found) {
                continue;
            }
            const auto place = map.georeference().toGeographic(
                GridPoint{static_cast<double>(c), static_cast<double>(r)});
            if (!place || std::isnan(height)) {
                continue;
            }
            const Place here{place->latitude.degrees(), place->longitude.degrees(), height};
            if (is_wanted(here)) {
                best = here;
                is_found = true;
            }
        }
    }
    EXPECT_TRUE(is_found);
    return best;
}

double distance_km(const Place& place, const NamedFeature& feature)
{
    return marsDistance_km(place.latitude_deg, place.longitude_deg, feature.latitude_deg,
                           feature.east_longitude_deg);
}

Place highestWithin(const Map& map, const NamedFeature& feature, double radius_km)
{
    return extreme(map, 1.0, [&](const Place& p) { return distance_km(p, feature) < radius_km; });
}

double heightAt(const Map& map, double latitude_deg, double longitude_deg)
{
    return map.height({Angle::degrees(longitude_deg), Angle::degrees(latitude_deg)});
}

// Coordinates of the Gazetteer of Planetary Nomenclature.
const NamedFeature kOlympus{"Olympus Mons", 610.13, 18.65, 226.2};
const NamedFeature kHellas{"Hellas Planitia", 2299.16, -42.43, 70.5};

void expectOlympusAndHellas(const Map& mars)
{
    const auto any = [](const Place&) { return true; };
    const Place summit = extreme(mars, 1.0, any);
    EXPECT_LT(distance_km(summit, kOlympus), kOlympus.diameter_km / 2.0);
    // The caldera is 80 km across, its floor 3 km below the rim.
    EXPECT_LT(distance_km(summit, kOlympus), 100.0)
        << summit.latitude_deg << " " << summit.longitude_deg;
    EXPECT_GT(heightAt(mars, kOlympus.latitude_deg, kOlympus.east_longitude_deg), 17000.0);
    EXPECT_EQ(summit.height_m, mars.heightfield().range()->maximum_m);
    const Place deepest = extreme(mars, -1.0, any);
    EXPECT_LT(distance_km(deepest, kHellas), kHellas.diameter_km / 2.0);
    EXPECT_LT(heightAt(mars, kHellas.latitude_deg, kHellas.east_longitude_deg), -6000.0);
    std::printf("summit %.2f N %.2f E, %.0f km from Olympus Mons; deepest %.2f N %.2f E\n",
                summit.latitude_deg, summit.longitude_deg, distance_km(summit, kOlympus),
                deepest.latitude_deg, deepest.longitude_deg);
    // The same with other turns of longitude.
    for (const double turn : {-720.0, -360.0, 360.0}) {
        EXPECT_NEAR(heightAt(mars, kOlympus.latitude_deg, kOlympus.east_longitude_deg + turn),
                    heightAt(mars, kOlympus.latitude_deg, kOlympus.east_longitude_deg), 1e-6);
    }
}

TEST(MolaPlacement, TheSummitIsOlympusMonsAndTheDeepestPointIsInHellas)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    EXPECT_EQ(test::marsFeature("Olympus Mons").latitude_deg, kOlympus.latitude_deg);
    EXPECT_EQ(test::marsFeature("Hellas Planitia").east_longitude_deg, kHellas.east_longitude_deg);
    const auto mars = load(test::sharedData() / "mars_mola/megt90n000cb.lbl");
    ASSERT_TRUE(mars);
    expectOlympusAndHellas(*mars);
    EXPECT_EQ(mars->info().body->name, "Mars");
    EXPECT_EQ(mars->info().vertical_datum, "areoid");
}

// One pixel is 0.25 degrees, 14.8 km: a grid that is one pixel off would still pass at the summits,
// so the outlines of the volcanoes are centered as well.
TEST(MolaPlacement, TheGreatVolcanoesPeakNearTheirNamedCenters)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    const auto mars = load(test::sharedData() / "mars_mola/megt90n000cb.lbl");
    ASSERT_TRUE(mars);
    for (const char* name :
         {"Olympus Mons", "Ascraeus Mons", "Pavonis Mons", "Arsia Mons", "Elysium Mons"}) {
        const NamedFeature feature = test::marsFeature(name);
        const Place top = highestWithin(*mars, feature, feature.diameter_km / 2.0);
        const double away_km = distance_km(top, feature);
        std::printf("%s: highest %.0f m, %.0f km from its named centre\n", name, top.height_m,
                    away_km);
        // The gazetteer's circle includes the aprons: the caldera of Pavonis lies 0.26 of the
        // diameter south of its center.
        EXPECT_LT(away_km, feature.diameter_km * 0.27) << name;
    }
}

TEST(MolaPlacement, TheCornersMatchTheLabel)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    const auto mars = load(test::sharedData() / "mars_mola/megt90n000cb.lbl");
    ASSERT_TRUE(mars);
    const Georeference& reference = mars->georeference();
    EXPECT_TRUE(reference.wrapsAround());
    // MAXIMUM_LATITUDE 90, WESTERNMOST_LONGITUDE 0, MINIMUM_LATITUDE -90, EASTERNMOST_LONGITUDE
    // 360; MAP_SCALE is rounded to 14.818 km, an error of 0.01 pixel at the edge.
    const struct {
        double longitude_deg;
        double latitude_deg;
        GridPoint corner;
    } corners[] = {
        {0.0001, 89.9999, {-0.5, -0.5}},
        {359.9999, -89.9999, {1439.5, 719.5}},
        {180.0, 0.0, {719.5, 359.5}},
    };
    for (const auto& c : corners) {
        const auto grid = reference.toGrid(
            GeographicPoint{Angle::degrees(c.longitude_deg), Angle::degrees(c.latitude_deg)});
        ASSERT_TRUE(grid);
        EXPECT_NEAR(grid->column, c.corner.column, 0.011) << c.longitude_deg;
        EXPECT_NEAR(grid->row, c.corner.row, 0.011) << c.latitude_deg;
    }
}

TEST(LolaPlacement, CornersSummitAndDeepestPointMatchPublishedValues)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    for (const char* file : {"moon_lola/LDEM_4.LBL", "moon_lola/ldem_4.cub"}) {
        SCOPED_TRACE(file);
        const auto moon = load(test::sharedData() / file);
        ASSERT_TRUE(moon);
        const Georeference& reference = moon->georeference();
        EXPECT_TRUE(reference.wrapsAround());
        const auto middle =
            reference.toGrid(GeographicPoint{Angle::degrees(180.0), Angle::degrees(0.0)});
        ASSERT_TRUE(middle);
        EXPECT_NEAR(middle->column, 719.5, 0.011);
        EXPECT_NEAR(middle->row, 359.5, 0.011);
        const auto corner =
            reference.toGrid(GeographicPoint{Angle::degrees(0.0001), Angle::degrees(89.9999)});
        ASSERT_TRUE(corner);
        EXPECT_NEAR(corner->column, -0.5, 0.011);
        EXPECT_NEAR(corner->row, -0.5, 0.011);
        // The Selenean summit: 10 786 m at 5.44 N, 201.37 E (LROC). Cells of 7.6 km average it.
        const auto any = [](const Place&) { return true; };
        const Place summit = extreme(*moon, 1.0, any);
        EXPECT_NEAR(summit.latitude_deg, 5.44, 0.3);
        EXPECT_NEAR(std::remainder(summit.longitude_deg - 201.37, 360.0), 0.0, 0.3);
        EXPECT_NEAR(summit.height_m, 10786.0, 400.0);
        // The deepest point, in Antoniadi: 70.4 S, 187.5 E, 9.1 km below the reference sphere.
        const Place deepest = extreme(*moon, -1.0, any);
        EXPECT_NEAR(deepest.latitude_deg, -70.4, 0.5);
        EXPECT_NEAR(std::remainder(deepest.longitude_deg - 187.5, 360.0), 0.0, 1.0);
        EXPECT_NEAR(deepest.height_m, -9100.0, 400.0);
        std::printf("%s: summit %.3f N %.3f E %.0f m, deepest %.3f N %.3f E %.0f m\n", file,
                    summit.latitude_deg, summit.longitude_deg, summit.height_m,
                    deepest.latitude_deg, deepest.longitude_deg, deepest.height_m);
    }
}

TEST(EarthPlacement, PeaksAndLakesAreAtTheirKnownPositions)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    const auto near = [](const Map& d, double lat, double lon, double degrees, double sign) {
        return extreme(d, sign, [=](const Place& p) {
            return std::hypot(p.latitude_deg - lat, p.longitude_deg - lon) < degrees;
        });
    };
    // Latitudes of the program are planetocentric: 46.0 geographic is 45.81.
    const auto centric = [](const Map& d, double lat) {
        return d.georeference().crs()->ellipsoid()->planetocentric(Angle::degrees(lat)).degrees();
    };
    const auto helens = load(test::sharedData() / "usgs_dem/SainteHelens.dem");
    ASSERT_TRUE(helens);
    const Place top = near(*helens, centric(*helens, 46.1912), -122.1944, 1.0, 1.0);
    EXPECT_NEAR(top.height_m, 2549.0, 10.0); // on the southern rim of the crater
    EXPECT_NEAR(top.latitude_deg, centric(*helens, 46.1912), 0.005);
    EXPECT_NEAR(top.longitude_deg, -122.1944, 0.008);
    const auto washington = load(test::sharedData() / "srtm/N44W072.hgt");
    ASSERT_TRUE(washington);
    const Place mount = near(*washington, centric(*washington, 44.2706), -71.3033, 1.0, 1.0);
    EXPECT_NEAR(mount.height_m, 1917.0, 15.0);
    EXPECT_NEAR(mount.latitude_deg, centric(*washington, 44.2706), 0.003);
    EXPECT_NEAR(mount.longitude_deg, -71.3033, 0.003);
}

TEST(EarthPlacement, GridLineRegisteredGridsDoNotWrap)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    const auto etopo = load(test::sharedData() / "etopo/ETOPO1_Ice_1deg.tif");
    ASSERT_TRUE(etopo);
    EXPECT_EQ(etopo->heightfield().columns(), 361U);
    EXPECT_FALSE(etopo->georeference().wrapsAround());
    // The first and the last column are the same meridian.
    for (const double latitude : {-80.0, -45.0, 0.0, 30.0, 60.0}) {
        EXPECT_NEAR(heightAt(*etopo, latitude, 179.999999), heightAt(*etopo, latitude, -179.999999),
                    1.0);
    }
}

TEST(BundledMars, CoversTheWholePlanetAtTheRightPosition)
{
    const auto path = test::bundledSamples() / "mars_mola_4ppd.tif";
    if (!std::filesystem::exists(test::bundledSamples())) {
        GTEST_SKIP() << "this tree has no resources/samples";
    }
    const auto mars = load(path);
    ASSERT_TRUE(mars);
    ASSERT_TRUE(mars->heightfield().range());
    EXPECT_EQ(mars->heightfield().range()->minimum_m, -8068.0);
    EXPECT_EQ(mars->heightfield().range()->maximum_m, 21134.0);
    ASSERT_NE(mars->info().body, nullptr);
    EXPECT_EQ(mars->info().body->name, "Mars");
    EXPECT_TRUE(mars->georeference().wrapsAround());
    const double columns = static_cast<double>(mars->heightfield().columns());
    const double rows = static_cast<double>(mars->heightfield().rows());
    const Georeference& reference = mars->georeference();
    const auto middle =
        reference.toGrid(GeographicPoint{Angle::degrees(180.0), Angle::degrees(0.0)});
    ASSERT_TRUE(middle);
    EXPECT_NEAR(middle->column, (columns - 1.0) / 2.0, 1e-6);
    EXPECT_NEAR(middle->row, (rows - 1.0) / 2.0, 1e-6);
    const auto corner =
        reference.toGrid(GeographicPoint{Angle::degrees(0.001), Angle::degrees(89.999)});
    ASSERT_TRUE(corner);
    EXPECT_NEAR(corner->column, -0.5 + 0.001 * columns / 360.0, 1e-6);
    EXPECT_NEAR(corner->row, -0.5 + 0.001 * rows / 180.0, 1e-6);
    expectOlympusAndHellas(*mars);
}

TEST(BundledMars, HasTheSamplesOfItsSourceProduct)
{
    if (!std::filesystem::exists(test::bundledSamples())) {
        GTEST_SKIP() << "this tree has no resources/samples";
    }
    MARSVIEW_NEEDS_SHARED_DATA();
    const auto bundled = load(test::bundledSamples() / "mars_mola_4ppd.tif");
    const auto product = load(test::sharedData() / "mars_mola/megt90n000cb.lbl");
    ASSERT_TRUE(bundled && product);
    ASSERT_EQ(bundled->heightfield().columns(), product->heightfield().columns());
    ASSERT_EQ(bundled->heightfield().rows(), product->heightfield().rows());
    for (std::size_t r = 0; r < product->heightfield().rows(); ++r) {
        for (std::size_t c = 0; c < product->heightfield().columns(); ++c) {
            ASSERT_EQ(bundled->heightfield().sample(c, r), product->heightfield().sample(c, r));
        }
    }
}

TEST(BundledMountStHelens, ShowsTheMountainAtItsKnownPosition)
{
    if (!std::filesystem::exists(test::bundledSamples())) {
        GTEST_SKIP() << "this tree has no resources/samples";
    }
    const auto helens = load(test::bundledSamples() / "mount_st_helens_30m.tif");
    ASSERT_TRUE(helens);
    const Place top = extreme(*helens, 1.0, [](const Place&) { return true; });
    EXPECT_NEAR(top.height_m, 2543.0, 7.0);
    EXPECT_NEAR(top.latitude_deg, 46.0, 0.01); // planetocentric of 46.19
    EXPECT_NEAR(top.longitude_deg, -122.19, 0.01);
    EXPECT_NEAR(helens->georeference().pixelWidthMeters(), 30.0, 0.01);
    EXPECT_NEAR(helens->georeference().pixelHeightMeters(), 30.0, 0.01);
}

} // namespace
} // namespace marsview
