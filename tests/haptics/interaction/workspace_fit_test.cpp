#include "haptics/interaction/workspace_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace marsview {
namespace {

constexpr double kFitStepS = 1e-3;
constexpr WorkspacePoint kFitHand{0.03, -0.02, 0.01};

// A workspace that is off by this way and so many octaves of the scale, seen from the hand.
struct Fitting {
    FitOptions options;
    WorkspaceFrame frame{.anchor = {0.01, 0.0, 0.0},
                         .place = {100.0, 200.0, 50.0},
                         .scene_per_meter = 1e4,
                         .turn = Angle::degrees(30.0)};
    WorkspaceFrame seen = frame;
    WorkspaceFit fit;

    explicit Fitting(const Vec3& way_m, double octaves = 0.0)
        : fit{.seen = frame, .fitted = frame.zoomed(kFitHand, std::exp2(-octaves)).panned(way_m)}
    {}
    WorkspaceFrame after(const FitPace& pace, double dt_s = kFitStepS) const
    {
        return fitted(options, fit, frame, seen, kFitHand, pace, dt_s);
    }
    // How far what is at the hand has moved.
    Vec3 shiftAfter(const FitPace& pace, double dt_s = kFitStepS) const
    {
        return after(pace, dt_s).toWorkspace(frame.toScene(kFitHand)) - kFitHand;
    }
    double octavesAfter(const FitPace& pace, double dt_s = kFitStepS) const
    {
        return std::log2(after(pace, dt_s).scene_per_meter / frame.scene_per_meter);
    }
};

TEST(WorkspaceFit, RestsNearTheSurfaceAndIsFastAwayFromIt)
{
    const FitOptions options;
    EXPECT_EQ(fitShare(options, options.clearance_min_m), 0.0);
    EXPECT_NEAR(fitShare(options, options.clearance_min_m + 0.5 * options.clearance_fade_m), 0.5,
                1e-12);
    EXPECT_EQ(fitShare(options, options.clearance_min_m + 2.0 * options.clearance_fade_m), 1.0);
    EXPECT_EQ(fitShare(options, -1.0), 0.0);
    EXPECT_EQ(fitShare(options, std::numeric_limits<double>::quiet_NaN()), 0.0);
}

// 15 mm/s, of which a share remains near the surface; in haste, what is left within a second.
TEST(WorkspaceFit, MovesStraightAtItsSpeed)
{
    const Vec3 way_m{0.03, -0.04, 0.0};
    const Fitting fitting(way_m);
    const Vec3 direction = way_m * (1.0 / 0.05);
    EXPECT_NEAR(length(fitting.shiftAfter({}) - direction * 0.015e-3), 0.0, 1e-12);
    EXPECT_NEAR(length(fitting.shiftAfter({.share = 0.4}) - direction * 0.006e-3), 0.0, 1e-12);
    EXPECT_NEAR(length(fitting.shiftAfter({.haste = 1.0}) - direction * 0.05e-3), 0.0, 1e-12);
    EXPECT_NEAR(length(fitting.shiftAfter({.haste = 7.0}) - direction * 0.05e-3), 0.0, 1e-12);
    EXPECT_NEAR(length(fitting.shiftAfter({.haste = 0.1}) - direction * 0.015e-3), 0.0, 1e-12);
    EXPECT_NEAR(length(fitting.shiftAfter({}, 10.0) - way_m), 0.0, 1e-12); // and no farther
    EXPECT_EQ(fitting.octavesAfter({}), 0.0);
}

TEST(WorkspaceFit, ScalesAboutTheHandAtItsRate)
{
    for (const double octaves : {-2.0, 2.0}) {
        const Fitting fitting({}, octaves);
        const double sign = octaves > 0.0 ? 1.0 : -1.0;
        EXPECT_NEAR(fitting.octavesAfter({}), sign * 0.3e-3, 1e-12);
        EXPECT_NEAR(fitting.octavesAfter({.share = 0.5}), sign * 0.15e-3, 1e-12);
        EXPECT_NEAR(fitting.octavesAfter({.haste = 1.0}), sign * 2e-3, 1e-12);
        EXPECT_NEAR(fitting.octavesAfter({}, 10.0), octaves, 1e-12);
        EXPECT_NEAR(length(fitting.shiftAfter({})), 0.0, 1e-12);
    }
}

// On a body the workspace turns too: 0.1 rad/s about the hand, in haste what is left within a
// second.
TEST(WorkspaceFit, OnABodyTurnsAboutTheHandAtItsRate)
{
    const auto turning = [](double turn_rad) {
        Fitting fitting({});
        fitting.frame.turn = {};
        fitting.frame.body_axes = Rotation{};
        fitting.seen = fitting.frame;
        fitting.fit = {.seen = fitting.frame,
                       .fitted = fitting.frame.turned(kFitHand, Angle::radians(-turn_rad))};
        return fitting;
    };
    for (const double turn_rad : {0.5, -0.5}) {
        const Fitting fitting = turning(turn_rad);
        const auto turn_after = [&](const FitPace& pace, double dt_s = kFitStepS) {
            EXPECT_NEAR(length(fitting.shiftAfter(pace, dt_s)), 0.0, 1e-12);
            return fitting.after(pace, dt_s).body_axes->turn().z;
        };
        const double sign = turn_rad > 0.0 ? 1.0 : -1.0;
        EXPECT_NEAR(turn_after({}), sign * 0.1e-3, 1e-12);
        EXPECT_NEAR(turn_after({.share = 0.5}), sign * 0.05e-3, 1e-12);
        EXPECT_NEAR(turn_after({.haste = 1.0}), sign * 0.5e-3, 1e-12);
        EXPECT_NEAR(turn_after({.haste = 0.1}), sign * 0.1e-3, 1e-12);
        EXPECT_NEAR(turn_after({}, 10.0), turn_rad, 1e-12); // and no farther
    }
    // A hundred-thousandth of a radian is not felt.
    EXPECT_EQ(turning(0.9e-5).after({}), turning(0.9e-5).frame);
    EXPECT_NE(turning(1.1e-5).after({}), turning(1.1e-5).frame);
}

// 0.02 mm and a ten-thousandth of an octave are not felt.
TEST(WorkspaceFit, RestsWhereItFits)
{
    EXPECT_EQ(Fitting({1.9e-5, 0.0, 0.0}).after({}), Fitting({}).frame);
    EXPECT_NE(Fitting({2.1e-5, 0.0, 0.0}).after({}), Fitting({}).frame);
    EXPECT_EQ(Fitting({}, 0.9e-4).after({}), Fitting({}).frame);
    EXPECT_NE(Fitting({}, 1.1e-4).after({}), Fitting({}).frame);
    const Fitting off({0.03, 0.0, 0.0}, 1.0);
    EXPECT_EQ(off.after({.share = 0.0}), off.frame);
    EXPECT_EQ(off.after({}, 0.0), off.frame);
    EXPECT_EQ(off.after({}, std::numeric_limits<double>::quiet_NaN()), off.frame);
}

// What fits moves with the camera.
TEST(WorkspaceFit, FollowsTheCamera)
{
    Fitting fitting({0.03, 0.0, 0.0});
    fitting.seen = fitting.seen.panned({0.0, 0.04, 0.0});
    const Vec3 shift_m = fitting.shiftAfter({}, 10.0);
    EXPECT_NEAR(length(shift_m - Vec3{0.03, 0.04, 0.0}), 0.0, 1e-12);
}

} // namespace
} // namespace marsview
