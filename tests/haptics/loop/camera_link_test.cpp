#include "haptics/loop/camera_link.h"

#include <gtest/gtest.h>

namespace marsview::test {
namespace {

// A window's end of a loop whose tick is imagined.
struct Window {
    FlatCameraLink link;
    LoopSettings settings;
    NavigationLimits limits;
    LoopFrame loop;
    double shown_m = 0.0; // by which the camera's limits move it, to the right
    int fits = 0;

    Window()
    {
        link.begin({.camera = {.target = {10.0, 20.0, 5.0}, .distance_m = 100.0},
                    .frame = {.place = {8.0, 15.0, 3.0}, .scene_per_meter = 1000.0}},
                   limits, settings);
        take();
    }
    // The loop takes the frame that it has been given.
    void take()
    {
        loop.seen = settings.frame;
        loop.number = settings.frame_number;
    }
    LinkStep follow()
    {
        return link.follow(
            loop, limits, settings,
            [this](OrbitCamera camera) {
                camera.target.x += shown_m;
                return camera;
            },
            [this] {
                ++fits;
                WorkspaceFrame fitted = loop.seen;
                fitted.scene_per_meter = 1500.0;
                return fitted;
            });
    }
    // Whether nothing happens, as between two motions.
    bool isQuiet()
    {
        const std::uint64_t number = settings.frame_number;
        const int before = fits;
        const LinkStep step = follow();
        return !step.has_moved_camera && !step.has_changed_settings && fits == before &&
               settings.frame_number == number;
    }
    // The camera shows the same place again, as after another size of the picture.
    void resize() { ASSERT_TRUE(link.keeps(link.view().camera)); }
};

TEST(CameraLink, AViewBeginsWithAFrameThatFits)
{
    Window window;
    EXPECT_EQ(window.settings.frame_number, 1U);
    EXPECT_EQ(window.settings.frame_origin, FrameOrigin::View);
    EXPECT_TRUE(window.settings.view_bounds);
    EXPECT_TRUE(window.isQuiet());
    window.resize();
    window.follow();
    ASSERT_TRUE(window.settings.fit);
    window.link.begin(window.link.view(), window.limits, window.settings);
    EXPECT_FALSE(window.settings.fit);
    EXPECT_EQ(window.settings.frame_number, 2U);
}

TEST(CameraLink, TheWorkspaceFitsAnotherPictureOnceTheHandLetsGo)
{
    Window window;
    window.resize();
    for (const StylusMode mode : {StylusMode::Pan, StylusMode::Zoom}) {
        window.loop.mode = mode;
        EXPECT_TRUE(window.isQuiet());
    }
    window.loop.mode = StylusMode::Press;
    const LinkStep step = window.follow();
    EXPECT_FALSE(step.has_moved_camera);
    EXPECT_TRUE(step.has_changed_settings);
    EXPECT_EQ(window.fits, 1);
    ASSERT_TRUE(window.settings.fit);
    EXPECT_EQ(window.settings.fit->seen, window.loop.seen);
    EXPECT_EQ(window.settings.fit->fitted.scene_per_meter, 1500.0);
    EXPECT_EQ(window.settings.frame_number, 1U) << "the surface stays where the hand feels it";
    EXPECT_TRUE(window.isQuiet()) << "once";
}

TEST(CameraLink, AnotherPlaceIsNotKept)
{
    Window window;
    OrbitCamera elsewhere = window.link.view().camera;
    elsewhere.target.x += 10.0;
    EXPECT_FALSE(window.link.keeps(elsewhere));
    EXPECT_EQ(window.link.view().camera.target.x, 10.0);
    EXPECT_TRUE(window.isQuiet());
}

// The hand pulls the map to the right by 2 mm, 2 m of the scene: the camera's target goes left.
TEST(CameraLink, TheCameraFollowsTheHand)
{
    Window window;
    window.loop.seen = window.loop.seen.panned({0.002, 0.0, 0.0});
    window.loop.mode = StylusMode::Pan;
    const LinkStep step = window.follow();
    EXPECT_TRUE(step.has_moved_camera);
    EXPECT_FALSE(step.has_changed_settings);
    EXPECT_NEAR(window.link.view().camera.target.x, 8.0, 1e-9);
    EXPECT_EQ(window.settings.frame_number, 1U);
    EXPECT_TRUE(window.isQuiet()) << "it holds";
    window.loop.mode = StylusMode::Hover;
    EXPECT_TRUE(window.follow().has_changed_settings) << "the workspace fits where the map rests";
    EXPECT_EQ(window.fits, 1);
}

// The camera stops a meter before: the loop gets the frame of the camera, 1 mm back.
TEST(CameraLink, BeyondTheLimitsTheMapReturnsToTheCamera)
{
    Window window;
    const WorkspaceFrame begin = window.loop.seen;
    window.loop.seen = begin.panned({0.002, 0.0, 0.0});
    window.loop.mode = StylusMode::Pan;
    window.shown_m = 1.0;
    const LinkStep step = window.follow();
    EXPECT_TRUE(step.has_moved_camera);
    EXPECT_TRUE(step.has_changed_settings);
    EXPECT_EQ(window.settings.frame_number, 2U);
    EXPECT_EQ(window.settings.frame_origin, FrameOrigin::Limit);
    EXPECT_NEAR(
        length(window.settings.frame.toScene({}) - begin.panned({0.001, 0.0, 0.0}).toScene({})),
        0.0, 1e-9);
    EXPECT_TRUE(window.isQuiet()) << "what the loop did before it took the frame does not count";
    window.take();
    EXPECT_TRUE(window.isQuiet());
}

} // namespace
} // namespace marsview::test
