#include "core/geo/crs.h"
#include "haptics/trace/replay_check.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace marsview::test {
namespace {

std::shared_ptr<const Georeference>
map(std::size_t columns, std::size_t rows, const std::string& crs)
{
    const auto transform = GeoTransform::fromTerms({10.0, 0.25, 0.0, 20.0, 0.0, -0.25}).value();
    return std::make_shared<const Georeference>(
        columns, rows, transform,
        crs.empty() ? std::nullopt : std::optional(Crs::fromText(crs).value()));
}

TEST(ReplayFit, DistinguishesTheMapsOfARecordingBySizeAndBody)
{
    const TempFolder folder;
    const auto recorded = [&](const std::string& part) {
        return folder.write("session.csv",
                            "x,y,z,map,part,model,radius_m,exaggeration,ground\n"
                            "12,18,3,1,7,god-object,0.5,2," +
                                part + "\n");
    };
    const auto mars = map(40, 30, "IAU_2015:49900");
    const auto moon = map(40, 30, "IAU_2015:30100");
    const auto nowhere = map(40, 30, "");
    const auto larger = map(41, 30, "IAU_2015:49900");
    const std::string frame = "/19.5/14.5/200.0/0.0/0.0/-200.0";
    const std::string of_mars = recorded("part/7/40/30/3396190.0/3376200.0" + frame);
    const auto fit = [](const std::string& file,
                        std::vector<std::shared_ptr<const Georeference>> maps) {
        return replayFit(file, maps).value();
    };
    EXPECT_FALSE(fit(of_mars, {mars}).other_map);
    EXPECT_FALSE(fit(of_mars, {moon, larger, mars}).other_map);
    const ReplayFit elsewhere = fit(of_mars, {moon, nowhere, larger});
    ASSERT_TRUE(elsewhere.other_map);
    EXPECT_EQ(elsewhere.other_map->columns, 40U);
    EXPECT_EQ(elsewhere.beside_count, 0U) << "it has the same position";
    EXPECT_FALSE(elsewhere.isElsewhere());

    const std::string of_none = recorded("part/7/40/30/0.0/0.0" + frame);
    EXPECT_FALSE(fit(of_none, {nowhere}).other_map);
    EXPECT_TRUE(fit(of_none, {mars}).other_map);
    // Two maps that were joined to one surface, the uppermost first.
    const auto joined = fit(recorded("part/7/40/30/3396190.0/3376200.0" + frame +
                                     " below/7/41/30/3396190.0/3376200.0" + frame),
                            {moon, mars, larger});
    EXPECT_FALSE(joined.other_map);
    using Indexes = std::vector<std::size_t>;
    const std::vector<std::shared_ptr<const Georeference>> shown{moon, mars, mars, larger};
    EXPECT_EQ(mapsOf(joined.parts.front(), shown), (Indexes{1, 3}));
    const std::vector<std::shared_ptr<const Georeference>> turned{larger, mars};
    EXPECT_EQ(mapsOf(joined.parts.front(), turned), Indexes{}) << "in another order";
    EXPECT_EQ(joined.otherThan(2), nullptr);
    EXPECT_NE(joined.otherThan(1), nullptr);
    const ReplayFit lower_missing = fit(recorded("part/7/40/30/3396190.0/3376200.0" + frame +
                                                 " below/7/41/30/3396190.0/3376200.0" + frame),
                                        {moon, mars});
    ASSERT_TRUE(lower_missing.other_map);
    EXPECT_EQ(lower_missing.other_map->columns, 41U);
    // Older files do not record the map.
    EXPECT_FALSE(fit(recorded(""), {moon}).other_map);
}

} // namespace
} // namespace marsview::test
