// Scale, offset and unit in a raster's metadata, where no field of the format holds them.
#include "core/raster/raster_file.h"
#include "tests/support/make_raster.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace marsview {
namespace {

using test::recipeFor;
using test::TempFolder;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::vector<std::int16_t> kSamples{100, 200, 300, 400, 500, 600, 700, 800, 900};

std::string metadataXml(const std::vector<std::pair<std::string, std::string>>& items)
{
    std::string xml = "<Metadata>";
    for (const auto& [key, value] : items) {
        xml += "<MDI key=\"" + key + "\">" + value + "</MDI>";
    }
    return xml + "</Metadata>";
}

class MetadataElevation : public testing::Test {
protected:
    RasterInfo ofRaster(const test::RasterRecipe& recipe, const std::vector<std::string>& items)
    {
        std::vector<std::string> options;
        for (const std::string& item : items) {
            options.insert(options.end(), {"-mo", item});
        }
        return infoOf(recipe, options);
    }
    RasterInfo ofRaster(const std::vector<std::string>& items)
    {
        return ofRaster(recipeFor(3, kSamples), items);
    }
    RasterInfo ofBand(const std::vector<std::pair<std::string, std::string>>& items,
                      const std::string& band_xml = {},
                      const std::vector<std::string>& of_raster = {})
    {
        test::RasterRecipe recipe = recipeFor(3, kSamples);
        recipe.band_xml = metadataXml(items) + band_xml;
        return ofRaster(recipe, of_raster);
    }

private:
    RasterInfo infoOf(const test::RasterRecipe& recipe, const std::vector<std::string>& options)
    {
        const std::string name = "map" + std::to_string(count_++) + ".tif";
        const auto file =
            RasterFile::open(test::writeRaster(folder_, name, "GTiff", recipe, options));
        EXPECT_TRUE(file) << file.error().message;
        return file ? file->info() : RasterInfo{};
    }

    TempFolder folder_;
    int count_ = 0;
};

// As a label in PDS3 or a netCDF file says it: elevation = 0.5 · 100 + 1000, in meters.
TEST_F(MetadataElevation, OfTheRasterAppliesToIntegers)
{
    for (const auto& [scale, offset] : {std::pair{"SCALE_FACTOR", "ADD_OFFSET"},
                                        {"scale_factor", "add_offset"},
                                        {"SCALING_FACTOR", "OFFSET"}}) {
        const RasterInfo info =
            ofRaster({std::string(scale) + "=0.5", std::string(offset) + "=1000", "UNITS=meters"});
        EXPECT_EQ(info.elevationScale().height(100.0), 1050.0) << scale;
        EXPECT_TRUE(info.is_unit_declared);
        EXPECT_THAT(info.notices, Contains("from the file's metadata: scale 0.5, offset 1000 "
                                           "(GDAL reads scale 1, offset 0)"));
    }
    const RasterInfo in_km = ofRaster({"SCALE_FACTOR=0.001", "UNITS=km"});
    EXPECT_EQ(in_km.elevationScale().height(100.0), 100.0);
    EXPECT_THAT(in_km.notices, Contains("from the file's metadata: scale 0.001, unit km (GDAL "
                                        "reads scale 1, unit none)"));
}

TEST_F(MetadataElevation, OfTheBandGoesBeforeThatOfTheRaster)
{
    const RasterInfo info =
        ofBand({{"scale_factor", "0.25"}, {"add_offset", "-4"}, {"units", "ft"}}, {},
               {"SCALE_FACTOR=7", "UNITS=km"});
    EXPECT_DOUBLE_EQ(info.elevationScale().height(100.0), 21.0 * 0.3048);
}

TEST_F(MetadataElevation, GoesAfterTheFieldsOfTheFormat)
{
    const RasterInfo info =
        ofBand({{"scale_factor", "7"}, {"units", "km"}}, "<UnitType>ft</UnitType><Scale>2</Scale>");
    EXPECT_DOUBLE_EQ(info.elevationScale().height(100.0), 200.0 * 0.3048);
    EXPECT_THAT(info.notices, Not(Contains(HasSubstr("metadata"))));
}

// A netCDF map that was converted with its scale applied keeps the metadata of the packed one.
TEST_F(MetadataElevation, IsNotAppliedToFloatsButNamed)
{
    test::RasterRecipe recipe = recipeFor(3, std::vector<float>(9, 250.0F));
    const RasterInfo info = ofRaster(recipe, {"SCALE_FACTOR=0.5", "ADD_OFFSET=3", "UNITS=m"});
    EXPECT_EQ(info.elevationScale().height(250.0), 250.0);
    EXPECT_THAT(info.notices,
                Contains("the file's metadata give scale 0.5 and offset 3, which are not applied "
                         "to floating-point samples; set scale and offset if they should be "
                         "(--scale, --offset)"));
}

TEST_F(MetadataElevation, OfOtherMeaningIsIgnored)
{
    // The scale factor of a projection, a position in a file, units of the map, texts.
    test::RasterRecipe projected = recipeFor(3, kSamples);
    projected.srs = "EPSG:32611";
    for (const RasterInfo& info :
         {ofRaster(projected, {"SCALE_FACTOR=0.9996"}), ofRaster({"OFFSET=2048"}),
          ofRaster({"UNITS=degrees"}), ofRaster({"SCALE_FACTOR=1", "ADD_OFFSET=0"}),
          ofRaster({"SCALE_FACTOR=1:24000"}), ofRaster({"SCALE_FACTOR=0"}),
          ofRaster({"SCALE_FACTOR=nan"})}) {
        EXPECT_EQ(info.elevationScale(), ElevationScale{});
        EXPECT_THAT(info.notices, Not(Contains(HasSubstr("metadata"))));
        EXPECT_FALSE(info.is_unit_declared);
    }
}

TEST_F(MetadataElevation, GivesWayToWhatTheUserSets)
{
    RasterOverrides overrides;
    overrides.scale = 2.0;
    const auto changed =
        withOverrides(ofRaster({"SCALE_FACTOR=0.5", "ADD_OFFSET=1000"}), overrides);
    ASSERT_TRUE(changed) << changed.error().message;
    EXPECT_EQ(changed->elevationScale().height(100.0), 1200.0);
    EXPECT_THAT(changed->notices,
                Contains("from the file's metadata: offset 1000 (GDAL reads offset 0)"));
}

} // namespace
} // namespace marsview
