#include "tests/support/random.h"
#include "ui/drawing/handle_grid.h"
#include "ui/drawing/item_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace marsview {
namespace {

struct NamedThing {
    std::uint32_t id = 0;
    std::string name;
    bool operator==(const NamedThing&) const = default;
};

ItemList<NamedThing> things(std::uint32_t count)
{
    ItemList<NamedThing> list;
    for (std::uint32_t id = 1; id <= count; ++id) {
        list.push_back({id, std::to_string(id)});
    }
    return list;
}

} // namespace

// Against a plain vector, through thousands of random changes.
TEST(ItemList, IsWhatAVectorWouldBe)
{
    test::Random random(11);
    ItemList<NamedThing> list;
    std::vector<NamedThing> truth;
    std::vector<std::pair<ItemList<NamedThing>, std::vector<NamedThing>>>
        kept; // as undo keeps them
    std::uint32_t next = 1;
    for (int step = 0; step < 4000; ++step) {
        const double choice = random.uniform(0.0, 1.0);
        const auto any = static_cast<std::uint32_t>(random.uniform(0.0, next));
        if (choice < 0.7) {
            list.push_back({next, "new"});
            truth.push_back({next++, "new"});
        } else if (choice < 0.9) {
            const auto found =
                std::find_if(truth.begin(), truth.end(),
                             [any](const NamedThing& thing) { return thing.id == any; });
            NamedThing* thing = list.edit(any);
            ASSERT_EQ(thing != nullptr, found != truth.end());
            if (thing != nullptr) {
                thing->name = std::to_string(step);
                found->name = std::to_string(step);
            }
        } else {
            const auto is_meant = [any](const NamedThing& thing) {
                return thing.id % 97 == any % 97;
            };
            list.eraseIf(is_meant);
            std::erase_if(truth, is_meant);
        }
        if (step % 100 == 0) {
            kept.emplace_back(list, truth);
        }
        ASSERT_EQ(list.size(), truth.size());
        ASSERT_EQ(list.empty(), truth.empty());
    }
    kept.emplace_back(list, truth);
    for (const auto& [value, expected] : kept) {
        ASSERT_TRUE(std::equal(value.begin(), value.end(), expected.begin(), expected.end()));
        EXPECT_TRUE(std::equal(value.rbegin(), value.rend(), expected.rbegin(), expected.rend()));
        for (std::size_t i = 0; i < expected.size(); i += 53) {
            EXPECT_EQ(value[i], expected[i]);
            ASSERT_NE(value.find(expected[i].id), nullptr);
            EXPECT_EQ(*value.find(expected[i].id), expected[i]);
        }
        EXPECT_EQ(value.find(next), nullptr);
        EXPECT_EQ(value.find(0), nullptr);
    }
}

TEST(ItemList, ACopyHoldsOnlyWhatChanged)
{
    ItemList<NamedThing> list = things(100'000);
    const ItemList<NamedThing> before = list;
    list.edit(50'000)->name = "other";
    std::size_t moved = 0;
    for (auto a = list.begin(), b = before.begin(); a != list.end(); ++a, ++b) {
        moved += &*a != &*b ? 1U : 0U;
    }
    EXPECT_GE(moved, 1U);
    EXPECT_LE(moved, 256U) << "of a hundred thousand";
    EXPECT_EQ(before.find(50'000)->name, "50000");
    EXPECT_FALSE(list == before);
    list.edit(50'000)->name = "50000";
    EXPECT_TRUE(list == before);
}

TEST(ItemList, TellsWhatDiffersFromAnotherList)
{
    test::Random random(12);
    ItemList<NamedThing> list = things(3000);
    for (int round = 0; round < 200; ++round) {
        const ItemList<NamedThing> before = list;
        std::set<std::uint32_t> removed;
        std::set<std::uint32_t> changed;
        for (std::size_t i = random.below(4); i > 0; --i) {
            const auto id = static_cast<std::uint32_t>(1 + random.below(3000));
            if (NamedThing* thing = list.edit(id); thing != nullptr && random.chance(0.7)) {
                thing->name = "round " + std::to_string(round);
                changed.insert(id);
            } else if (thing != nullptr) {
                list.eraseIf([id](const NamedThing& each) { return each.id == id; });
                removed.insert(id);
                changed.erase(id);
            }
        }
        std::set<std::uint32_t> added;
        if (random.chance(0.3)) {
            const std::uint32_t id = list.back().id + 1;
            list.push_back({id, "new"});
            added.insert(id);
        }
        const auto expect = [&](const ItemList<NamedThing>& from, const ItemList<NamedThing>& to,
                                const std::set<std::uint32_t>& fresh,
                                const std::set<std::uint32_t>& gone) {
            std::set<std::uint32_t> found_fresh;
            std::set<std::uint32_t> found_gone;
            std::set<std::uint32_t> found_changed;
            ItemList<NamedThing>::forEachChange(
                from, to, [&](const NamedThing* was, const NamedThing* is) {
                    const std::uint32_t id = was != nullptr ? was->id : is->id;
                    EXPECT_EQ(was, from.find(id));
                    EXPECT_EQ(is, to.find(id));
                    (was == nullptr  ? found_fresh
                     : is == nullptr ? found_gone
                                     : found_changed)
                        .insert(id);
                });
            EXPECT_EQ(found_fresh, fresh);
            EXPECT_EQ(found_gone, gone);
            EXPECT_EQ(found_changed, changed);
        };
        expect(before, list, added, removed);
        expect(list, before, removed, added);
        EXPECT_EQ(before == list, added.empty() && removed.empty() && changed.empty());
    }
}

TEST(HandleGrid, MarksThatAreShownAreApartAndStandForTheOthers)
{
    test::Random random(5);
    constexpr double kGap = 6.0;
    HandleGrid grid(QRectF(10.0, 20.0, 500.0, 300.0), kGap);
    std::vector<QPointF> all;
    std::vector<QPointF> shown;
    for (int i = 0; i < 50'000; ++i) {
        all.emplace_back(random.uniform(10.0, 510.0), random.uniform(20.0, 320.0));
        if (grid.take(all.back())) {
            shown.push_back(all.back());
        }
    }
    EXPECT_LE(shown.size(), 85U * 51U);
    for (std::size_t i = 0; i < all.size(); i += 97) {
        const bool has_one = std::any_of(shown.begin(), shown.end(), [&](QPointF place) {
            return std::abs(place.x() - all[i].x()) <= kGap &&
                   std::abs(place.y() - all[i].y()) <= kGap;
        });
        EXPECT_TRUE(has_one);
    }
    EXPECT_FALSE(grid.take({9.0, 30.0})) << "outside";
}

} // namespace marsview
