#include "core/session/session.h"
#include "tests/support/make_raster.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace marsview {
namespace {

// Sessions of rasters of 12 × 10 pixels.
class SuitsGlobeTest : public testing::Test {
protected:
    std::shared_ptr<const Map> at(const std::string& srs, const std::array<double, 6>& terms)
    {
        test::RasterRecipe recipe = test::recipeFor(12, std::vector<float>(120, 1.0F));
        recipe.srs = srs;
        recipe.transform = terms;
        JobMonitor monitor;
        auto map = readMap(
            RasterSpec{test::writeVrt(folder_, "map" + std::to_string(count_++), recipe), 1, {}},
            monitor, std::size_t{1} << 20);
        EXPECT_TRUE(map) << map.error().message;
        return map ? *map : nullptr;
    }
    // From the north pole, the prime meridian at its western edge.
    std::shared_ptr<const Map> degrees(const std::string& srs, double pixel_deg)
    {
        return at(srs, {0.0, pixel_deg, 0.0, 90.0, 0.0, -pixel_deg});
    }
    static Session sessionOf(const std::vector<std::shared_ptr<const Map>>& maps)
    {
        Session session;
        for (const auto& map : maps) {
            session = added(session, {.map = map});
        }
        return session;
    }

private:
    test::TempFolder folder_;
    int count_ = 0;
};

// A map covers half the product of the share of the longitudes and the difference of the sines of
// its latitudes.
TEST_F(SuitsGlobeTest, FromATenthOfTheBodyOn)
{
    // Around the equator.
    EXPECT_FALSE(suitsGlobe(sessionOf({at("IAU_2015:49900", {0.0, 30.0, 0.0, 5.5, 0.0, -1.1})})))
        << "0.0958";
    EXPECT_TRUE(suitsGlobe(sessionOf({at("IAU_2015:49900", {0.0, 30.0, 0.0, 6.0, 0.0, -1.2})})))
        << "0.1045";
    EXPECT_FALSE(suitsGlobe(sessionOf({degrees("EPSG:4326", 7.6)}))) << "0.0960";
    EXPECT_TRUE(suitsGlobe(sessionOf({degrees("EPSG:4326", 7.8)}))) << "0.1030";
}

TEST_F(SuitsGlobeTest, CountsPlacesUnderSeveralLayersOnce)
{
    const auto map = degrees("IAU_2015:49900", 7.6);
    EXPECT_FALSE(suitsGlobe(sessionOf({map, map})));
    // The other side of the body.
    const auto other = at("IAU_2015:49900", {180.0, 2.0, 0.0, 10.0, 0.0, -2.0});
    EXPECT_TRUE(suitsGlobe(sessionOf({map, other}))) << "0.0960 + 0.0116";
    Session hidden = sessionOf({map, other});
    hidden = withVisibility(hidden, hidden.layers.front().id, false);
    EXPECT_FALSE(suitsGlobe(hidden));
}

TEST_F(SuitsGlobeTest, ForSmallLayersOnlyIfTheirCrssDiffer)
{
    const auto utm = at("EPSG:32611", {500000.0, 30.0, 0.0, 4000000.0, 0.0, -30.0});
    const auto beside = at("EPSG:32611", {600000.0, 30.0, 0.0, 4000000.0, 0.0, -30.0});
    EXPECT_FALSE(suitsGlobe(sessionOf({utm, beside})));
    EXPECT_TRUE(suitsGlobe(sessionOf({utm, degrees("EPSG:4326", 0.01)})));
    EXPECT_FALSE(suitsGlobe(sessionOf({degrees("IAU_2015:49900", 0.01), utm}))) << "two bodies";
}

TEST_F(SuitsGlobeTest, NotWithoutABodyOnTop)
{
    EXPECT_FALSE(suitsGlobe({}));
    const auto mars = degrees("IAU_2015:49900", 9.0);
    const auto nowhere = at("", {0.0, 30.0, 0.0, 90.0, 0.0, -30.0});
    EXPECT_FALSE(suitsGlobe(sessionOf({mars, nowhere}))) << "it is added on top";
    EXPECT_TRUE(suitsGlobe(sessionOf({nowhere, mars})));
}

} // namespace
} // namespace marsview
