#include "app/bench/touch_sessions.h"

#include <gtest/gtest.h>

namespace marsview::test {
namespace {

// `marsview-cli bench stability --sessions N` runs more of them.
TEST(TouchSessions, HoldTheirInvariants)
{
    TouchSessionResult sum;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        const TouchSessionResult result = runTouchSession({.seed = seed});
        EXPECT_EQ(result.violationCount(), 0U) << "seed " << seed << ": " << result.first;
        sum.add(result);
    }
    // All of it was tried.
    EXPECT_GT(sum.contact_ticks, sum.ticks / 10);
    EXPECT_GT(sum.pan_ticks, 1000U);
    EXPECT_GT(sum.zoom_ticks, 1000U);
    EXPECT_GT(sum.gliding_ticks, 100U);
}

// The hand ends against the wall at the map's edge, beyond the last samples, with the nearest
// terrain 1.5 mm below it.
TEST(TouchSessions, CountTheNearestTerrainAtTheMapsEdgeAsWithinReach)
{
    const TouchSessionResult result = runTouchSession({.seed = 30432});
    EXPECT_EQ(result.violationCount(), 0U) << result.first;
}

TEST(TouchSessions, AreTheSameForTheSameSeed)
{
    const TouchSessionResult a = runTouchSession({.seed = 7, .seconds = 1.0});
    const TouchSessionResult b = runTouchSession({.seed = 7, .seconds = 1.0});
    EXPECT_EQ(a.energy_j_max, b.energy_j_max);
    EXPECT_EQ(a.force_n_max, b.force_n_max);
    EXPECT_EQ(a.contact_ticks, b.contact_ticks);
}

} // namespace
} // namespace marsview::test
