#include "app/bench/stability_case.h"

#include <gtest/gtest.h>

#include <string>

namespace marsview::test {
namespace {

// The stiffness that the device of these runs states, and every lower one, at any supported delay.
class Stability : public testing::TestWithParam<ContactModelKind> {};

TEST_P(Stability, HoldsUpToTheStatedStiffnessInEveryScene)
{
    for (const StabilityScene scene : kStabilityScenes) {
        for (const double delay_s : {0.0, 1e-3, 2e-3, 3e-3}) {
            for (const double share : {0.1, 0.3, 0.6, 0.8, 1.0}) {
                const StabilityResult result =
                    runStability(scene, {.model = GetParam(),
                                         .stiffness_n_per_m = share * kStatedStiffnessNPerM,
                                         .delay_s = delay_s});
                EXPECT_TRUE(result.isStable())
                    << stabilitySceneName(scene) << ", " << 1e3 * delay_s << " ms, "
                    << share * kStatedStiffnessNPerM << " N/m: ripple " << 1e6 * result.ripple_m
                    << " um, " << result.speed_m_per_s << " m/s, " << result.energy_j_max << " J";
                if (scene != StabilityScene::ZoomHold) {
                    EXPECT_GT(result.contact_share, 0.5); // otherwise nothing was pressed
                }
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Models,
                         Stability,
                         testing::ValuesIn(kContactModelKinds),
                         [](const auto& parameter) {
                             std::string name(contactModelName(parameter.param));
                             std::erase(name, '-');
                             return name;
                         });

// Why the terrain force fades near a workspace wall: together the two are stiffer than either one.
TEST(StabilityCase, TheNaiveSumOfWallAndTerrainIsUnstableWhereTheFadeIsStable)
{
    StabilityOptions options{.stiffness_n_per_m = kStatedStiffnessNPerM, .delay_s = 3e-3};
    EXPECT_TRUE(runStability(StabilityScene::WallCorner, options).isStable());
    options.mixing = ForceMixing::NaiveSum;
    const StabilityResult naive = runStability(StabilityScene::WallCorner, options);
    EXPECT_FALSE(naive.isStable());
    EXPECT_GT(naive.ripple_m, 1e-3);
}

// A criterion that every run meets would prove nothing.
TEST(StabilityCase, ASpringTooStiffForItsDelayIsUnstable)
{
    const StabilityOptions options{.stiffness_n_per_m = 4000.0, .delay_s = 3e-3};
    for (const StabilityScene scene : kStabilityScenes) {
        EXPECT_FALSE(runStability(scene, options).isStable()) << stabilitySceneName(scene);
    }
}

TEST(StabilityCase, IsDeterministic)
{
    const StabilityOptions options{.delay_s = 1e-3, .seed = 5};
    const StabilityResult a = runStability(StabilityScene::ModeSwitches, options);
    const StabilityResult b = runStability(StabilityScene::ModeSwitches, options);
    EXPECT_EQ(a.ripple_m, b.ripple_m);
    EXPECT_EQ(a.energy_j_max, b.energy_j_max);
}

} // namespace
} // namespace marsview::test
