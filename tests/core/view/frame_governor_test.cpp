// A simulated clock: frames take the time of a simulated machine.
#include "core/view/frame_governor.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace marsview::test {
namespace {

constexpr double kPixels = 1280.0 * 800.0;
constexpr Milliseconds kTarget{33.0};
constexpr std::array kSteps{1.0, 1.4, 2.0, 2.8, 4.0, 5.6, 8.0};

// The cost of a scene: in many terrains the number of triangles falls with about this power of the
// error.
struct FakeScene {
    double sharp_triangles = 3e5;

    std::size_t triangles(double error_px) const
    {
        return static_cast<std::size_t>(sharp_triangles / std::pow(error_px, 1.3));
    }
};

// A machine, a scene, and the governor between them, used as in ui/render/governed_picture.cpp.
struct Loop {
    FrameCost machine;
    FakeScene scene;
    FrameCost belief = softwareFrameCost();
    FramePlan plan{};
    bool is_touching = false;

    Milliseconds timeOf(const FramePlan& of) const
    {
        return machine.predicted({.triangle_count = scene.triangles(of.error_px),
                                  .pixel_count = kPixels * of.scale * of.scale});
    }
    Milliseconds frame(double slowness = 1.0)
    {
        plan = planFrame(belief,
                         {.target = kTarget, .pixel_count = kPixels, .is_touching = is_touching},
                         plan, [this](const FramePlan& p) { return scene.triangles(p.error_px); });
        const Milliseconds taken = timeOf(plan) * slowness;
        belief = learned(belief,
                         {.triangle_count = scene.triangles(plan.error_px),
                          .pixel_count = kPixels * plan.scale * plan.scale},
                         taken);
        return taken;
    }
    void frames(int count)
    {
        for (int i = 0; i < count; ++i) {
            frame();
        }
    }
};

Loop randomLoop(Random& random)
{
    const auto spread = [&random](double low, double high) {
        return low * std::pow(high / low, random.uniform(0.0, 1.0));
    };
    Loop loop;
    loop.machine = {.base = Milliseconds(spread(0.3, 8.0)),
                    .per_triangle = Milliseconds(spread(3e-6, 6e-4)),
                    .per_pixel = Milliseconds(spread(1e-6, 3e-5))};
    loop.scene.sharp_triangles = spread(1e4, 3e6);
    return loop;
}

// The steps of the plan from the finest, 0, to the coarsest.
int stepOf(const FramePlan& plan)
{
    const auto errors = std::count_if(kSteps.begin(), kSteps.end(),
                                      [&](double error_px) { return error_px < plan.error_px; });
    const auto last = plan.error_px > kErrorPxLarge ? 1 : 0;
    return static_cast<int>(errors) + (plan.scale < 1.0 ? 1 : 0) + last;
}

} // namespace

TEST(FrameGovernor, ReachesTheTargetOnUnexpectedMachines)
{
    Random random;
    for (int i = 0; i < 500; ++i) {
        Loop loop = randomLoop(random);
        loop.frames(150);
        const bool is_coarsest =
            loop.plan == FramePlan{.error_px = kErrorPxMax, .scale = kScaleMin};
        EXPECT_TRUE(loop.plan.error_px <= kErrorPxLarge || loop.plan.scale == kScaleMin) << i;
        EXPECT_TRUE(loop.timeOf(loop.plan) <= kTarget * 1.1 || is_coarsest)
            << i << ": " << loop.timeOf(loop.plan).count() << " ms";
        // Nor is it coarser than necessary: two steps finer would be too slow.
        if (loop.plan.scale == 1.0 && stepOf(loop.plan) >= 2) {
            const double finer_px = kSteps[static_cast<std::size_t>(stepOf(loop.plan) - 2)];
            EXPECT_GT(loop.timeOf({.error_px = finer_px, .scale = 1.0}), kTarget * 0.65)
                << i << ": at " << loop.plan.error_px << " px";
        }
    }
}

TEST(FrameGovernor, SettlesUnderConstantLoad)
{
    Random random;
    for (int i = 0; i < 500; ++i) {
        Loop loop = randomLoop(random);
        loop.frames(500); // at most 17 s
        int changes = 0;
        for (int frame = 0; frame < 300; ++frame) {
            const FramePlan before = loop.plan;
            loop.frame();
            changes += loop.plan == before ? 0 : 1;
        }
        EXPECT_EQ(changes, 0) << i;
    }
}

TEST(FrameGovernor, HardlyReactsToVariationsOfATenth)
{
    Random random;
    int changes = 0;
    constexpr int kLoops = 200;
    constexpr int kFrames = 300;
    for (int i = 0; i < kLoops; ++i) {
        Loop loop = randomLoop(random);
        loop.frames(150);
        for (int frame = 0; frame < kFrames; ++frame) {
            const FramePlan before = loop.plan;
            loop.frame(random.uniform(0.9, 1.1));
            changes += loop.plan == before ? 0 : 1;
        }
    }
    EXPECT_LE(changes, kLoops * kFrames / 100) << "less than one in a hundred frames";
}

TEST(FrameGovernor, IgnoresASingleSlowFrame)
{
    Random random;
    for (int i = 0; i < 200; ++i) {
        Loop loop = randomLoop(random);
        loop.frames(150);
        const int settled = stepOf(loop.plan);
        loop.frame(25.0);
        int coarsest = 0;
        for (int frame = 0; frame < 20; ++frame) {
            loop.frame();
            coarsest = std::max(coarsest, stepOf(loop.plan));
        }
        EXPECT_LE(coarsest, settled + 2) << i;
        EXPECT_LE(stepOf(loop.plan), settled + 1) << i;
    }
}

TEST(FrameGovernor, FollowsAChangeOfLoadWithinAThirdOfASecond)
{
    Loop loop;
    loop.machine = softwareFrameCost();
    loop.scene.sharp_triangles = 5e4;
    loop.frames(20);
    EXPECT_EQ(loop.plan.error_px, 1.0);
    loop.scene.sharp_triangles = 4e5;
    for (int frame = 0; frame < 3; ++frame) {
        loop.frame();
    }
    EXPECT_LE(loop.timeOf(loop.plan), kTarget * 1.1) << "predicted, not measured";
    // Another program takes half of the processor time.
    loop.machine = {loop.machine.base * 2.0, loop.machine.per_triangle * 2.0,
                    loop.machine.per_pixel * 2.0};
    loop.frames(10);
    EXPECT_LE(loop.timeOf(loop.plan), kTarget * 1.2);
}

TEST(FrameGovernor, ReducesPixelsBeforeTheSurfaceInContact)
{
    Random random;
    for (int i = 0; i < 500; ++i) {
        Loop loop = randomLoop(random);
        loop.is_touching = true;
        loop.frames(150);
        const bool is_feasible =
            loop.timeOf({.error_px = 1.0, .scale = kScaleMin}) <= kTarget * 0.7;
        if (is_feasible) {
            EXPECT_EQ(loop.plan.error_px, 1.0) << i;
        }
        if (loop.plan.error_px > 1.0) {
            EXPECT_EQ(loop.plan.scale, kScaleMin) << i << ": resolution is reduced first";
        }
    }
}

TEST(FrameGovernor, RestsAtOnePixelUnlessTheTrianglesOutnumberTheSamplesOfTheSmoothPicture)
{
    constexpr double kPixels = 1e6;
    const auto plan_of = [&](double triangles_at_one_px, double least) {
        return planAtRest(kPixels, [=](const FramePlan& plan) {
            EXPECT_EQ(plan.scale, 1.0);
            return static_cast<std::size_t>(
                std::max(triangles_at_one_px / (plan.error_px * plan.error_px), least));
        });
    };
    EXPECT_EQ(plan_of(0.0, 0.0), FramePlan{});
    EXPECT_EQ(plan_of(4e6, 0.0), FramePlan{});
    // 16 million triangles at 1 px are 4 million at 2 px.
    EXPECT_EQ(plan_of(16e6, 0.0), FramePlan{.error_px = 2.0});
    EXPECT_EQ(plan_of(4e6 * 16.0 * 16.0, 0.0), FramePlan{.error_px = 16.0});
    // Even the coarsest has too many: it is drawn nevertheless.
    EXPECT_EQ(plan_of(1e9, 5e6), FramePlan{.error_px = kErrorPxMax});
}

TEST(FrameGovernor, StaysWithinItsBoundsForAnyFrameTime)
{
    Random random;
    for (int i = 0; i < 200; ++i) {
        Loop loop = randomLoop(random);
        for (int frame = 0; frame < 200; ++frame) {
            loop.is_touching = random.uniform(0.0, 1.0) < 0.3;
            loop.scene.sharp_triangles = std::pow(10.0, random.uniform(0.0, 8.0));
            loop.frame(std::pow(10.0, random.uniform(-6.0, 6.0)));
            ASSERT_GE(loop.plan.error_px, 1.0);
            ASSERT_LE(loop.plan.error_px, kErrorPxMax);
            ASSERT_GE(loop.plan.scale, kScaleMin);
            ASSERT_LE(loop.plan.scale, 1.0);
            for (const Milliseconds term :
                 {loop.belief.base, loop.belief.per_triangle, loop.belief.per_pixel}) {
                ASSERT_TRUE(std::isfinite(term.count()) && term.count() > 0.0);
            }
        }
    }
}

} // namespace marsview::test
