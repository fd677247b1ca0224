#include "core/body/body_positions.h"
#include "haptics/interaction/body_frame.h"
#include "haptics/interaction/body_modes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace marsview {
namespace {

constexpr double kRollStepS = 1e-3;
constexpr double kRolledRadiusM = 1e6;
constexpr double kRolledScale = 2e7; // the ball has a radius of 50 mm in the workspace
constexpr Ellipsoid kRolledBall{kRolledRadiusM, kRolledRadiusM};

// The ball's center is at the workspace's origin, and 30° north 60° east is up.
WorkspaceFrame frameAroundBall()
{
    const BodySite site{
        .place = {.longitude = Angle::degrees(60.0), .latitude = Angle::degrees(30.0)}};
    return {.anchor = {},
            .place = {},
            .scene_per_meter = kRolledScale,
            .body_axes = axesAt(kRolledBall, site)};
}

// Near the center of the body the lever is too short to roll it.
TEST(BodyModes, AHandRollsTheBodyFromATenthOfItsRadiusOn)
{
    for (const double share : {0.05, 0.09, 0.11, 0.15, 1.0}) {
        const ModeOptions options;
        ModeState state;
        BodyModeState body_state;
        ModeInput input{.hand = {0.0, 0.0, share * kRolledRadiusM / kRolledScale},
                        .is_grabbing = true,
                        .is_in_contact = true,
                        .stiffness_n_per_m = 400.0,
                        .frame = frameAroundBall()};
        stepBodyModes(options, input, kRolledBall, state, body_state, kRollStepS);
        EXPECT_EQ(state.mode, StylusMode::Pan);
        input.hand_shift = {1e-3, 0.0, 0.0};
        input.hand = input.hand + input.hand_shift;
        for (int i = 0; i < 10; ++i) {
            stepBodyModes(options, input, kRolledBall, state, body_state, kRollStepS);
        }
        // A hand that moves to the right turns the top about the axis that points away.
        EXPECT_EQ(body_state.spin_rad_per_s.y > 0.0, share > 0.1) << share;
    }
}

// The paper's zoom about a point 20 mm over the terrain: what is between that point and the hand
// shrinks by the magnification. The lift itself carries the terrain along.
TEST(BodyModes, AZoomMagnifiesAboutAPointBelowTheHand)
{
    const ModeOptions options;
    ModeState state;
    BodyModeState body_state;
    constexpr double kClearanceM = 0.05;
    constexpr double kRiseM = 0.006;
    ModeInput input{.hand = {0.0, 0.0, kRolledRadiusM / kRolledScale + kClearanceM},
                    .is_grabbing = true,
                    .stiffness_n_per_m = 400.0,
                    .clearance_m = kClearanceM,
                    .frame = frameAroundBall()};
    stepBodyModes(options, input, kRolledBall, state, body_state, kRollStepS);
    EXPECT_EQ(state.mode, StylusMode::Zoom);
    input.hand_shift = {0.0, 0.0, kRiseM};
    input.hand = input.hand + input.hand_shift;
    input.clearance_m += kRiseM;
    const ModeStep step = stepBodyModes(options, input, kRolledBall, state, body_state, kRollStepS);
    const double factor = zoomFactor(options.zoom, kRiseM);
    EXPECT_NEAR(step.frame.scene_per_meter, kRolledScale / factor, 1e-6);
    const double height_m = verticalAt(kRolledBall, step.frame.toScene(input.hand)).height_m;
    const double above_m = kClearanceM - kZoomHeightM;
    EXPECT_NEAR(height_m, (kZoomHeightM + above_m / factor) * kRolledScale, 1e-3);
    const double lifted_m =
        verticalAt(kRolledBall, step.seen_from.toScene(input.hand)).height_m; // with the hand
    EXPECT_NEAR(lifted_m, kClearanceM * kRolledScale, 1e-3);
}

} // namespace
} // namespace marsview
