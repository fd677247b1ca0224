// The scene that View › Scene › Automatic chooses.
#include "tests/ui/globe/globe_window.h"
#include "tests/ui/project_files.h"
#include "ui/commands/window_commands.h"

namespace marsview {
namespace {

class AutomaticSceneTest : public GlobeTest {
protected:
    void SetUp() override
    {
        WindowOptions options = testWindowOptions();
        options.scene = SceneChoice::Automatic;
        makeWindow(kSmall, options);
    }
    bool openMars() { return openAndWait(*window_, QString::fromStdString(test::bundledMars())); }
    bool isGlobe() { return view().isHidden() && !globe().isHidden(); }
};

TEST_F(AutomaticSceneTest, AWholePlanetIsAGlobeAndALandingSiteIsFlat)
{
    ASSERT_TRUE(openMars());
    EXPECT_TRUE(isGlobe());
    EXPECT_TRUE(scene(0)->isChecked());
    ASSERT_TRUE(openAndWait(*window_, maps_.mars())); // 10° of it
    EXPECT_TRUE(isGlobe()) << "both together";
    SessionController& session = window_->controller();
    const LayerId planet = window_->session().layers.back().id;
    session.setVisible(planet, false);
    EXPECT_FALSE(isGlobe());
    EXPECT_EQ(view().shownLayers().size(), 1U);
    session.undoStack().undo();
    EXPECT_TRUE(isGlobe());
    ASSERT_TRUE(waitUntilSettled(*window_));
    EXPECT_EQ(globe().scene().maps().size(), 2U);
    EXPECT_TRUE(scene(0)->isChecked());
}

// The overview map has 0° in its middle.
TEST_F(AutomaticSceneTest, AWholeBodyIsSeenFromItsPrimeMeridian)
{
    ASSERT_TRUE(openAndWait(
        *window_, maps_.placed("whole", "IAU_2015:30100", {0.0, 9.0, 0.0, 90.0, 0.0, -6.0})));
    ASSERT_TRUE(isGlobe());
    EXPECT_NEAR(globe().camera().target.longitude.degrees(), 0.0, 1e-6);
    EXPECT_NEAR(globe().camera().target.latitude.degrees(), 0.0, 1e-6);
    EXPECT_EQ(globe().camera().tilt, Angle{});
}

TEST_F(AutomaticSceneTest, MarsIsSeenBetweenTharsisAndVallesMarineris)
{
    ASSERT_TRUE(openMars());
    EXPECT_NEAR(globe().camera().target.longitude.degrees(), 266.0 - 360.0, 0.1);
    EXPECT_NEAR(globe().camera().target.latitude.degrees(), -1.0, 0.1);
}

TEST_F(AutomaticSceneTest, LayersInSeveralCrssAreOnTheGlobe)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    EXPECT_FALSE(isGlobe());
    ASSERT_TRUE(openAndWait(*window_, maps_.placed("polar", "IAU_2015:49930",
                                                   {-400e3, 20e3, 0.0, -300e3, 0.0, -20e3})));
    EXPECT_TRUE(isGlobe());
    EXPECT_EQ(globe().scene().maps().size(), 2U);
    // Maps of another body replace it in the picture.
    ASSERT_TRUE(openAndWait(*window_, maps_.moon()));
    EXPECT_FALSE(isGlobe());
}

TEST_F(AutomaticSceneTest, TheUsersChoiceHolds)
{
    ASSERT_TRUE(openMars());
    scene(1)->trigger();
    EXPECT_FALSE(isGlobe());
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    EXPECT_FALSE(isGlobe());
    scene(0)->trigger();
    EXPECT_TRUE(isGlobe());
}

TEST_F(AutomaticSceneTest, AProjectKeepsTheCameraOfTheGlobe)
{
    ASSERT_TRUE(openMars());
    const BodyCamera camera{
        .target = {.longitude = Angle::degrees(-60.0), .latitude = Angle::degrees(-10.0)},
        .distance_m = 2e6,
        .azimuth = Angle::degrees(30.0),
        .tilt = Angle::degrees(20.0)};
    globe().setCamera(camera);
    const BodyCamera left = globe().camera();
    const QString file = maps_.path(QStringLiteral("planet.mvproj"));
    ASSERT_TRUE(saveProject(window_->commands().project, file));
    globe().setCamera({.target = {}, .distance_m = 9e6});
    ASSERT_TRUE(openProject(window_->commands().project, file));
    ASSERT_TRUE(waitUntilSettled(*window_));
    EXPECT_TRUE(isGlobe());
    EXPECT_TRUE(scene(0)->isChecked());
    EXPECT_NEAR(globe().camera().target.longitude.degrees(), left.target.longitude.degrees(), 1e-9);
    EXPECT_NEAR(globe().camera().target.latitude.degrees(), left.target.latitude.degrees(), 1e-9);
    EXPECT_NEAR(globe().camera().distance_m, left.distance_m, 1e-3);
    EXPECT_NEAR(globe().camera().azimuth.degrees(), left.azimuth.degrees(), 1e-9);
}

} // namespace
} // namespace marsview
