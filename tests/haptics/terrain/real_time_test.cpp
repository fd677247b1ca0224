// Replaces operator new in this test program only, to count allocations.
#include "core/contact/contact_model.h"
#include "haptics/terrain/resident_terrain.h"
#include "tests/core/contact/contact_terrain.h"
#include "tests/core/mesh/mesh_shapes.h"
#include "tests/haptics/terrain/tiled_map.h"
#include "tests/support/fractal_terrain.h"
#include "tests/support/make_terrain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

namespace {

std::atomic<long> allocation_count{0};
std::atomic<long> free_count{0};

// Not inlined; otherwise the compiler takes the freed memory for malloc's.
[[gnu::noinline]] void* counted(std::size_t bytes)
{
    allocation_count.fetch_add(1, std::memory_order_relaxed);
    void* memory = std::malloc(bytes == 0 ? 1 : bytes); // NOLINT
    if (memory == nullptr) {
        throw std::bad_alloc();
    }
    return memory;
}

} // namespace

void* operator new(std::size_t bytes)
{
    return counted(bytes);
}
void* operator new[](std::size_t bytes)
{
    return counted(bytes);
}
// AddressSanitizer replaces these operators, and its versions must not meet our delete.
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept
{
    allocation_count.fetch_add(1, std::memory_order_relaxed);
    return std::malloc(bytes == 0 ? 1 : bytes); // NOLINT
}
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept
{
    allocation_count.fetch_add(1, std::memory_order_relaxed);
    return std::malloc(bytes == 0 ? 1 : bytes); // NOLINT
}
void operator delete(void* memory) noexcept
{
    free_count.fetch_add(1, std::memory_order_relaxed);
    std::free(memory); // NOLINT
}
void operator delete[](void* memory) noexcept
{
    free_count.fetch_add(1, std::memory_order_relaxed);
    std::free(memory); // NOLINT
}
void operator delete(void* memory, std::size_t) noexcept
{
    free_count.fetch_add(1, std::memory_order_relaxed);
    std::free(memory); // NOLINT
}
void operator delete[](void* memory, std::size_t) noexcept
{
    free_count.fetch_add(1, std::memory_order_relaxed);
    std::free(memory); // NOLINT
}

namespace marsview {
namespace {

static_assert(noexcept(std::declval<ContactModel&>().update(ScenePoint{})));
static_assert(noexcept(std::declval<ContactModel&>().place(ScenePoint{})));

TEST(RealTime, TheCounterCounts)
{
    const long before = allocation_count.load();
    auto made = std::make_unique<std::vector<int>>(100);
    EXPECT_EQ(allocation_count.load(), before + 2);
    const long freed_before = free_count.load();
    made.reset();
    EXPECT_EQ(free_count.load(), freed_before + 2);
}

class ContactModelRealTime : public testing::TestWithParam<ContactModelKind> {};

TEST_P(ContactModelRealTime, AllocatesNothingOverMaps)
{
    test::Random random;
    for (const auto& [name, terrain] : test::syntheticTerrains()) {
        for (const double radius_m : {0.1, 1.0}) {
            const HeightfieldSurface surface(terrain, test::unitFrame(*terrain), 1.0);
            std::vector<ScenePoint> goals(1000);
            ScenePoint goal{};
            for (ScenePoint& next : goals) {
                next = goal = test::wanderingGoal(random, surface, goal, 5.0);
            }
            const auto model = makeContactModel(GetParam(), surface, {.radius_m = radius_m});
            const long before = allocation_count.load();
            for (const ScenePoint& next : goals) {
                model->update(next);
            }
            model->place(goals.front());
            model->setExaggeration(2.0);
            model->update(goals.back());
            EXPECT_EQ(allocation_count.load(), before) << name;
        }
    }
}

TEST_P(ContactModelRealTime, AllocatesAndFreesNothingOverTilesThatArrive)
{
    test::Random random;
    const auto heights = test::fractalHeights(900, 700, 2);
    const test::TiledMap map = test::tiledMap(
        test::floatTerrain(900, 700, [&heights](std::size_t column, std::size_t row) {
            return static_cast<double>(heights[row * 900 + column]);
        }));
    const SceneFrame frame = test::unitFrame(*map.filled);
    const HeightfieldSurface truth(map.filled, frame, 1.0);
    // All windows are built in advance, as a streamer does.
    std::vector<std::unique_ptr<Clipmap>> windows;
    windows.push_back(std::make_unique<Clipmap>(map.window({450.0, 350.0})));
    for (const TileId& id : test::tilesOf(*windows.front())) {
        auto next = std::make_unique<Clipmap>(*windows.back());
        next->put(map.tile(id), 0.0);
        next->put(next->slot(id)->tile, next->differenceFromCoarser(id));
        windows.push_back(std::move(next));
    }
    const auto terrain = std::make_shared<ResidentTerrain>(
        *windows.front(), map.heights, ResidentTerrainOptions{.rate_m_per_s = 5.0});
    const auto model = makeContactModel(GetParam(), TiledHeightfieldSurface(terrain, frame, 1.0),
                                        {.radius_m = 0.3});
    std::vector<ScenePoint> goals(3000);
    ScenePoint goal{};
    for (ScenePoint& next : goals) {
        next = goal = test::wanderingGoal(random, truth, goal, 5.0);
    }
    const long before = allocation_count.load();
    const long freed_before = free_count.load();
    for (std::size_t i = 0; i < goals.size(); ++i) {
        const GridPoint hand = frame.toGrid(model->state().proxy);
        if (i % 100 == 50 && i / 100 < windows.size()) {
            terrain->show(*windows[i / 100], hand);
        }
        if (terrain->advance(hand, 0.001)) {
            model->terrainChanged();
        }
        model->update(goals[i]);
    }
    EXPECT_EQ(allocation_count.load(), before);
    EXPECT_EQ(free_count.load(), freed_before);
    EXPECT_GT(terrain->misses().count, 1000U);
}

TEST_P(ContactModelRealTime, AllocatesNothingOverMeshes)
{
    test::Random random;
    for (const auto& soup : {test::cube(), test::star(), test::torus(24, 12)}) {
        const MeshSurface surface(test::meshOf(soup));
        const auto model = makeContactModel(GetParam(), surface, {.radius_m = 0.1});
        std::vector<ScenePoint> goals(1000);
        for (ScenePoint& goal : goals) {
            goal = {random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0),
                    random.uniform(-2.0, 2.0)};
        }
        const long before = allocation_count.load();
        model->place({0.0, 0.0, 3.0});
        for (const ScenePoint& goal : goals) {
            model->update(goal);
        }
        EXPECT_EQ(allocation_count.load(), before);
    }
}

INSTANTIATE_TEST_SUITE_P(Models,
                         ContactModelRealTime,
                         testing::ValuesIn(kContactModelKinds),
                         [](const auto& model) {
                             std::string name(contactModelName(model.param));
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

} // namespace
} // namespace marsview
