// The step limit of an update: ContactCounters::cut_short and S::stepsMax().
#include "core/contact/continuous_walk.h"
#include "core/contact/heightfield_surface.h"
#include "core/contact/proxy_graph.h"
#include "core/contact/proxy_graph_2003.h"
#include "core/contact/surface_walk.h"
#include "tests/core/contact/contact_terrain.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace marsview {
namespace {

using test::distance;

constexpr int kSide = 201;

// A trench one sample wide that winds from the northwestern to the southeastern corner, row by row
// along every second one, and falls by 0.01 m a sample. Between its rows are walls.
std::shared_ptr<const FilledHeightfield> windingTrench()
{
    constexpr double kWall = 400.0;
    std::vector<float> heights;
    for (int r = 0; r < kSide; ++r) {
        const bool goes_east = r / 2 % 2 == 0;
        for (int c = 0; c < kSide; ++c) {
            const int along = goes_east ? c : kSide - 1 - c;
            const bool is_trench = r % 2 == 0 || along == kSide - 1;
            const int samples = r / 2 * (kSide + 1) + along + r % 2;
            heights.push_back(static_cast<float>(is_trench ? 300.0 - 0.01 * samples : kWall));
        }
    }
    return test::filledTerrain(kSide, heights);
}

// The goal is so deep below the trench's beginning that every sample farther along is nearer to it:
// on 1 m of the way, 0.01 m of 1e6 m outweigh 300 m. A step passes one sample at most.
template <typename Model>
void goesOn(int cut_updates_min)
{
    const HeightfieldSurface surface = test::surfaceOver(windingTrench());
    const ScenePoint goal{-100.0, 100.0, -1e6};
    const ScenePoint end{100.0, -100.0, surface.height({kSide - 1.0, kSide - 1.0})};
    Model model(surface);
    double last_m = std::numeric_limits<double>::infinity();
    int cut_updates = 0;
    ContactState state = model.place(goal);
    while (state.counters.cut_short != 0 && cut_updates < 10) {
        ++cut_updates;
        ASSERT_EQ(state.counters.cut_short, 1U);
        ASSERT_TRUE(state.is_in_contact);
        const GridPoint at = surface.frame().toGrid(state.proxy);
        EXPECT_NEAR(state.proxy.z, test::bruteHeight(surface, at), 1e-9);
        ASSERT_LT(distance(state.proxy, goal), last_m) << "an update continues from the last";
        last_m = distance(state.proxy, goal);
        state = model.update(goal);
    }
    EXPECT_EQ(state.proxy, end);
    EXPECT_GE(cut_updates, cut_updates_min);
}

TEST(StepLimit, AnUpdateThatReachesItEndsOnTheSurfaceAndTheNextContinues)
{
    ASSERT_EQ(test::surfaceOver(windingTrench()).stepsMax(), 4096U + 12U * (kSide + kSide));
    goesOn<ProxyGraph<HeightfieldSurface>>(2); // for 20,401 samples
    goesOn<ProxyGraph2003<HeightfieldSurface>>(2);
    goesOn<SurfaceWalk<HeightfieldSurface>>(2);
    goesOn<ContinuousWalk<HeightfieldSurface>>(1); // several descents in an update
}

} // namespace
} // namespace marsview
