// Replaces operator new of this test program, and of no other, to count what is allocated.
#include "core/contact/god_object.h"
#include "core/contact/proxy_graph.h"
#include "core/contact/virtual_proxy.h"
#include "tests/core/contact/contact_terrain.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace {

std::atomic<long> allocation_count{0};

void* counted(std::size_t bytes)
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
// AddressSanitizer has its own of these, which must not meet our delete.
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
    std::free(memory); // NOLINT
}
void operator delete[](void* memory) noexcept
{
    std::free(memory); // NOLINT
}
void operator delete(void* memory, std::size_t) noexcept
{
    std::free(memory); // NOLINT
}
void operator delete[](void* memory, std::size_t) noexcept
{
    std::free(memory); // NOLINT
}

namespace marsview {
namespace {

using Model = ProxyGraph<HeightfieldSurface>;

static_assert(noexcept(std::declval<Model&>().update(ScenePoint{})));
static_assert(noexcept(std::declval<Model&>().place(ScenePoint{})));

TEST(ProxyGraphRealTime, TheCounterCounts)
{
    const long before = allocation_count.load();
    const auto made = std::make_unique<std::vector<int>>(100);
    EXPECT_EQ(allocation_count.load(), before + 2);
}

template <typename Make>
void expectNoAllocation(const Make& make)
{
    test::Random random;
    for (const auto& [name, terrain] : test::syntheticTerrains()) {
        const HeightfieldSurface surface(terrain, test::unitFrame(*terrain), 1.0);
        std::vector<ScenePoint> goals(2000);
        ScenePoint goal{};
        for (ScenePoint& next : goals) {
            next = goal = test::wanderingGoal(random, surface, goal, 5.0);
        }
        auto model = make(surface);
        HeightfieldSurface taller(terrain, surface.frame(), 2.0);
        const long before = allocation_count.load();
        for (const ScenePoint& next : goals) {
            model.update(next);
        }
        model.place(goals.front());
        model.setSurface(std::move(taller));
        EXPECT_EQ(allocation_count.load(), before) << name;
    }
}

TEST(ProxyGraphRealTime, UpdatesAllocateNothing)
{
    expectNoAllocation([](const HeightfieldSurface& surface) { return Model(surface); });
}

TEST(GodObjectRealTime, UpdatesAllocateNothing)
{
    for (const auto constraints : {GodObjectConstraints::Kept, GodObjectConstraints::Released}) {
        expectNoAllocation([constraints](const HeightfieldSurface& surface) {
            return GodObject<HeightfieldSurface>(surface, constraints);
        });
    }
}

TEST(VirtualProxyRealTime, UpdatesAllocateNothing)
{
    for (const double radius_m : {0.1, 1.0}) {
        expectNoAllocation([radius_m](const HeightfieldSurface& surface) {
            return VirtualProxy<HeightfieldSurface>(surface, radius_m);
        });
    }
}

} // namespace
} // namespace marsview
