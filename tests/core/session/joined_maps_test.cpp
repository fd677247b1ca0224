#include "core/session/joined_maps.h"
#include "tests/support/map_maker.h"

#include <gtest/gtest.h>

#include <vector>

namespace marsview {
namespace {

using test::MapMaker;

BodyTerrain terrain(MapMaker& maker, const MapMaker::Place& place)
{
    const auto map = maker.make(place, [](std::size_t, std::size_t) { return 0.0; });
    JobMonitor monitor;
    return {map, BodyGrid::make(map->georeference(), monitor).value()};
}

// Degrees: the western and the northern border, and the size.
BodyTerrain part(MapMaker& maker, double west, double north, double width, double height)
{
    return terrain(maker,
                   {21, 11, {west, width / 21.0, 0, north, 0, -height / 11.0}, "IAU_2015:49900"});
}

TEST(JoinedMaps, PilesAreMapsWithAPlaceInCommonDirectlyOrByOthers)
{
    MapMaker maker;
    const BodyTerrain whole = terrain(maker, {18, 9, {0, 20, 0, 90, 0, -20}, "IAU_2015:49900"});
    const BodyTerrain polar =
        terrain(maker, {30, 30, {-150e3, 10e3, 0, 150e3, 0, -10e3}, "IAU_2015:49930"});
    const BodyTerrain a = part(maker, 10.0, 10.0, 10.0, 10.0);
    const BodyTerrain inside = part(maker, 372.0, 8.0, 2.0, 2.0); // in another turn
    const BodyTerrain corner = part(maker, 19.0, 1.0, 5.0, 5.0);
    const BodyTerrain strip = part(maker, 0.0, 6.0, 40.0, 1.0); // across a, and longer
    const auto expect = [](const BodyTerrain& one, const BodyTerrain& other, bool do_overlap) {
        EXPECT_EQ(doOverlap(one, other), do_overlap);
        EXPECT_EQ(doOverlap(other, one), do_overlap);
    };
    expect(a, inside, true);
    expect(a, corner, true);
    expect(a, strip, true);
    expect(corner, strip, false);
    expect(corner, inside, false);
    expect(whole, a, true);
    expect(whole, polar, true);
    expect(polar, a, false);
    expect(a, a, true);

    const BodyScene scene({polar, corner, inside, strip, a, polar});
    using Piles = std::vector<std::vector<std::size_t>>;
    EXPECT_EQ(pilesOf(scene, {0, 1, 2, 3, 4, 5}), (Piles{{0, 5}, {1, 2, 3, 4}}));
    EXPECT_EQ(pilesOf(scene, {0, 1, 2, 3}), Piles{}) << "what joins them is left out";
    EXPECT_EQ(pilesOf(scene, {4, 3}), (Piles{{4, 3}}));
}

} // namespace
} // namespace marsview
