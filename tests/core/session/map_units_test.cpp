// Elevations in feet, radii and kilometers are converted to meters.
#include "core/raster/raster_file.h"
#include "core/session/map.h"
#include "tests/support/gdal_tools.h"
#include "tests/support/map_maker.h"
#include "tests/support/random.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <vector>

namespace marsview {
namespace {

std::shared_ptr<const Map> load(const std::string& path, const RasterOverrides& overrides = {})
{
    JobMonitor monitor;
    auto map = readMap(RasterSpec{path, 1, overrides}, monitor, defaultMemoryBudget());
    EXPECT_TRUE(map) << map.error().message;
    return map ? *map : nullptr;
}

// A USGS DEM is ASCII in records of 1024 characters. Record A holds the unit of elevations in
// columns 535 to 540 (1 feet, 2 meters) and the resolution, a factor for every elevation, in
// columns 841 to 852. With feet and a resolution of 1/0.3048, the file holds the same elevations in
// feet without a change to the samples.
std::string inFeet(std::string dem)
{
    EXPECT_EQ(dem.substr(534, 6), "     2");
    dem.replace(534, 6, "     1");
    EXPECT_EQ(dem.substr(840, 12), "0.100000E+01");
    dem.replace(840, 12, "0.328084E+01");
    return dem;
}

TEST(Units, AUsgsDemInFeetMatchesTheOneInMeters)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    const test::TempFolder folder;
    const auto original = test::sharedData() / "usgs_dem/SainteHelens.dem";
    const auto meters = load(original.string());
    const auto feet = load(folder.write("feet.dem", inFeet(test::readFile(original))));
    ASSERT_TRUE(meters && feet);
    EXPECT_EQ(meters->info().unit.name, "m");
    EXPECT_EQ(feet->info().unit.name, "ft");
    EXPECT_TRUE(feet->info().is_unit_declared);
    EXPECT_EQ(feet->info().unit.meters, 0.3048);
    // The resolution has six digits, an error of 3e-8; feet are stored as floats, with steps of
    // 0.0005 up to 8343.
    const double tolerance_m = 3e-8 * 2543.0 + 0.5 * 0.001 * 0.3048;
    double worst_m = 0.0;
    for (std::size_t r = 0; r < meters->heightfield().rows(); ++r) {
        for (std::size_t c = 0; c < meters->heightfield().columns(); ++c) {
            const double expected = meters->heightfield().sample(c, r);
            const double found = feet->heightfield().sample(c, r);
            ASSERT_EQ(std::isnan(found), std::isnan(expected)) << c << " " << r;
            if (!std::isnan(expected)) {
                worst_m = std::max(worst_m, std::abs(found - expected));
            }
        }
    }
    std::printf("worst difference %.4f m\n", worst_m);
    EXPECT_LE(worst_m, tolerance_m);
    EXPECT_NEAR(feet->heightfield().range()->maximum_m, 2543.0, tolerance_m);
}

TEST(Units, TheUserSetsFeetThatTheFileDoesNotDeclare)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    const std::string path = (test::sharedData() / "derived/trinidad_co_3as.tif").string();
    const auto assumed = load(path);
    RasterOverrides overrides;
    overrides.vertical_unit = "ft";
    const auto feet = load(path, overrides);
    ASSERT_TRUE(assumed && feet);
    EXPECT_FALSE(assumed->info().is_unit_declared);
    EXPECT_TRUE(feet->info().is_unit_declared);
    test::Random random;
    std::vector<test::Pixel> pixels;
    pixels.reserve(500);
    for (int i = 0; i < 500; ++i) {
        pixels.push_back({random.below(2401), random.below(1201)});
    }
    const std::vector<double> raw = test::rawSamples(path, pixels);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const test::Pixel& p = pixels[i];
        if (raw[i] == -999.0) {
            EXPECT_TRUE(std::isnan(feet->heightfield().sample(p.column, p.row)));
            continue;
        }
        const auto stored = static_cast<double>(static_cast<float>(raw[i]));
        EXPECT_EQ(assumed->heightfield().sample(p.column, p.row), stored);
        EXPECT_EQ(feet->heightfield().sample(p.column, p.row), stored * 0.3048);
    }
    EXPECT_NEAR(feet->heightfield().range()->maximum_m, 14176.16 * 0.3048, 0.01);
    // The same without reading the file again.
    const auto in_feet = test::overridden(*assumed, overrides);
    ASSERT_TRUE(in_feet) << in_feet.error().message;
    EXPECT_EQ((*in_feet)->heightfield().sample(1000, 500), feet->heightfield().sample(1000, 500));
}

TEST(Units, TheUsersScaleAndOffsetApplyWithoutRereading)
{
    const std::string path = (test::bundledSamples() / "mars_mola_4ppd.tif").string();
    const auto mars = load(path);
    ASSERT_TRUE(mars);
    RasterOverrides overrides;
    overrides.scale = -0.5; // the smallest sample becomes the highest elevation
    overrides.offset = 12.0;
    overrides.vertical_datum = "local datum";
    const auto changed = test::overridden(*mars, overrides);
    ASSERT_TRUE(changed) << changed.error().message;
    const std::vector<test::Pixel> pixels{{0, 0}, {1439, 719}, {528, 285}, {700, 333}};
    const std::vector<double> raw = test::rawSamples(path, pixels);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        EXPECT_DOUBLE_EQ((*changed)->heightfield().sample(pixels[i].column, pixels[i].row),
                         raw[i] * -0.5 + 12.0);
    }
    EXPECT_EQ((*changed)->heightfield().range()->minimum_m, 21134.0 * -0.5 + 12.0);
    EXPECT_EQ((*changed)->heightfield().range()->maximum_m, -8068.0 * -0.5 + 12.0);
    EXPECT_EQ((*changed)->info().vertical_datum, "local datum");
    EXPECT_EQ((*changed)->spec().overrides, overrides);
    // And back.
    const auto again = test::overridden(**changed, {});
    ASSERT_TRUE(again);
    EXPECT_EQ((*again)->heightfield().sample(528, 285), raw[2]);
    overrides.scale = 0.0;
    const auto refused = test::overridden(*mars, overrides);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refusedField(refused.error()), OverrideField::Scale) << refused.error().message;
}

TEST(Units, RadiiOfTheMoonAreHeightsAboveTheirReferenceSphere)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    const std::string path = (test::sharedData() / "moon_lola/LDEM_4.LBL").string();
    const auto moon = load(path);
    ASSERT_TRUE(moon);
    ASSERT_TRUE(moon->info().reference_radius_m);
    EXPECT_EQ(*moon->info().reference_radius_m, 1737400.0);
    EXPECT_NE(moon->info().vertical_datum.find("1737400"), std::string::npos);
    test::Random random;
    std::vector<test::Pixel> pixels;
    pixels.reserve(500);
    for (int i = 0; i < 500; ++i) {
        pixels.push_back({random.below(1440), random.below(720)});
    }
    const std::vector<double> raw = test::rawSamples(path, pixels);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        // The label: HEIGHT = DN * SCALING_FACTOR, with a factor of 0.5.
        EXPECT_EQ(moon->heightfield().sample(pixels[i].column, pixels[i].row), raw[i] * 0.5);
    }
}

} // namespace
} // namespace marsview
