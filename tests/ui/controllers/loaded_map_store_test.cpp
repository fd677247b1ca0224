#include "tests/support/make_raster.h"
#include "ui/controllers/loaded_map_store.h"

#include <gtest/gtest.h>

#include <vector>

namespace marsview {
namespace {

LoadedMap mapIn(const test::TempFolder& folder, const std::string& name)
{
    JobMonitor monitor;
    const auto path =
        test::writeVrt(folder, name, test::recipeFor(4, std::vector<float>(16, 1.0F)));
    LoadedMap map;
    map.dataset = *loadDataset({.path = path}, monitor, std::size_t{1} << 20);
    map.relief = std::make_shared<const ReliefTile>();
    return map;
}

TEST(LoadedMapStore, FindsWhatItKeptAndHoldsNothingItself)
{
    const test::TempFolder folder;
    LoadedMapStore store;
    const LoadedMap map = mapIn(folder, "a");
    const std::weak_ptr<const ReliefTile> relief = map.relief;
    auto kept = store.keep(map);
    EXPECT_EQ(kept.get(), map.dataset.get());
    EXPECT_EQ(store.find(kept).relief, map.relief);
    EXPECT_EQ(store.count(), 1U);
    auto copy = kept; // an undo step
    kept.reset();
    EXPECT_EQ(store.count(), 1U);
    copy.reset();
    EXPECT_EQ(store.count(), 0U);
    EXPECT_FALSE(store.find(map.dataset));
}

TEST(LoadedMapStore, FreesAllOfAMapWithItsLastOwner)
{
    const test::TempFolder folder;
    LoadedMapStore store;
    std::weak_ptr<const ReliefTile> relief;
    std::shared_ptr<const Dataset> kept;
    {
        const LoadedMap map = mapIn(folder, "a");
        relief = map.relief;
        kept = store.keep(map);
    }
    EXPECT_FALSE(relief.expired());
    kept.reset();
    EXPECT_TRUE(relief.expired());
}

} // namespace
} // namespace marsview
