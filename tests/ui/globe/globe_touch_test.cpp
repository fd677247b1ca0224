// Touch with the mouse on the globe.
#include "core/globe/body_camera.h"
#include "tests/ui/globe/globe_window.h"
#include "ui/overlay/force_meter.h"
#include "ui/overlay/globe_overlays.h"
#include "ui/overlay/hand_pointer.h"

#include <QImage>
#include <QMouseEvent>
#include <QTest>

#include <cmath>

namespace marsview {
namespace {

class GlobeTouchTest : public GlobeTest {
protected:
    GlobeOverlays& overlays() { return *globe().findChild<GlobeOverlays*>(); }
    QAction* tool(Tool tool)
    {
        return window_->actionSet().tools->actions().at(static_cast<int>(tool));
    }
    bool beginTouch(double longitude_deg, double latitude_deg, double distance_m)
    {
        if (!showGlobe()) {
            return false;
        }
        tool(Tool::Touch)->trigger();
        globe().setCamera({.target = {.longitude = Angle::degrees(longitude_deg),
                                      .latitude = Angle::degrees(latitude_deg)},
                           .distance_m = distance_m});
        return waitFor([this] { return globe().isTouchReady(); });
    }
    void send(QEvent::Type type, QPointF at, Qt::MouseButtons buttons)
    {
        QMouseEvent event(type, at, globe().mapToGlobal(at), Qt::LeftButton, buttons,
                          Qt::NoModifier);
        QApplication::sendEvent(&globe(), &event);
    }
    void press(QPointF at) { send(QEvent::MouseButtonPress, at, Qt::LeftButton); }
    void release(QPointF at) { send(QEvent::MouseButtonRelease, at, Qt::NoButton); }
};

TEST_F(GlobeTouchTest, TheKeyThatChoosesTheToolOnTheFlatMapDoesSoOnTheGlobe)
{
    ASSERT_TRUE(showGlobe());
    globe().setFocus();
    ASSERT_TRUE(waitFor([this] { return globe().hasFocus(); }));
    EXPECT_TRUE(tool(Tool::Touch)->isEnabled());
    QTest::keyClick(&globe(), Qt::Key_T);
    EXPECT_TRUE(tool(Tool::Touch)->isChecked());
    EXPECT_TRUE(waitFor([this] { return globe().isTouchReady(); }));
}

TEST_F(GlobeTouchTest, HoversOverTheGroundAndPressesIntoItAlongTheLocalVertical)
{
    ASSERT_TRUE(beginTouch(-133.0, 40.0, 1e6));
    move(globeMiddle());
    ASSERT_TRUE(globe().stylus());
    EXPECT_EQ(globe().stylus()->mode, StylusMode::Hover);
    EXPECT_EQ(overlays().forceMeter()->sizeHint().isEmpty(), true);
    const ScenePoint ground = pointAt(globeMiddle());
    const Vec3 up = localAxes(body(), placeOf(ground, body()).foot).up;
    EXPECT_NEAR(dot(normalized(globe().stylus()->goal - ground), up), 1.0, 1e-9);

    press(globeMiddle());
    ASSERT_TRUE(globe().stylus());
    EXPECT_EQ(globe().stylus()->mode, StylusMode::Press);
    EXPECT_TRUE(globe().stylus()->is_in_contact);
    EXPECT_NEAR(dot(normalized(globe().stylus()->goal - ground), up), -1.0, 1e-9);
    // The proxy is on the terrain of the map.
    const BodyPlace proxy = placeOf(globe().stylus()->proxy, body());
    EXPECT_NEAR(proxy.height_m, globe().terrain()->height(proxy.foot) * globe().exaggeration(),
                0.02 * globe().terrain()->map()->georeference().pixelHeightMeters());
    EXPECT_TRUE(overlays().forceMeter()->isVisible());

    const double before_n = length(globe().stylus()->force_n);
    wheel(globeMiddle(), 3); // less deep
    EXPECT_LT(length(globe().stylus()->force_n), before_n);
    release(globeMiddle());
    EXPECT_FALSE(globe().stylus()->is_in_contact);
    EXPECT_FALSE(overlays().forceMeter()->isVisible());
    EXPECT_EQ(globe().camera().distance_m, 1e6);
}

TEST_F(GlobeTouchTest, StrokesAcrossTheSeamOfTheMapAndOverThePole)
{
    for (const auto& [longitude, latitude] :
         {std::pair{0.0, 5.0}, {180.0, -20.0}, {40.0, 89.0}, {-120.0, -89.5}}) {
        ASSERT_TRUE(beginTouch(longitude, latitude, 1.5e6));
        press(globeMiddle() - QPointF(200.0, 30.0));
        std::optional<ScenePoint> last;
        for (int x = -200; x <= 200; x += 4) {
            move(globeMiddle() + QPointF(x, 0.15 * x), Qt::LeftButton);
            ASSERT_TRUE(globe().stylus() && globe().stylus()->is_in_contact)
                << longitude << ", " << latitude << ", " << x;
            const ScenePoint proxy = globe().stylus()->proxy;
            const Vec3 step = last ? proxy - *last : Vec3{};
            EXPECT_LT(length(step), 1.5e5) << longitude << ", " << latitude << ", " << x;
            last = proxy;
        }
        release(globeMiddle());
    }
}

TEST_F(GlobeTouchTest, TheCursorIsDrawnOverThePicture)
{
    ASSERT_TRUE(beginTouch(-133.0, 10.0, 1e6));
    ASSERT_TRUE(waitFor([this] { return globe().isPictureComplete(); }));
    const QImage before = globe().grabFramebuffer();
    press(globeMiddle());
    const QImage after = globe().grabFramebuffer();
    int red = 0;
    for (int y = 0; y < after.height(); ++y) {
        for (int x = 0; x < after.width(); ++x) {
            const QColor color = after.pixelColor(x, y);
            red +=
                color.red() > 120 && color.green() < 40 && after.pixel(x, y) != before.pixel(x, y)
                    ? 1
                    : 0;
        }
    }
    EXPECT_GT(red, 60);
    release(globeMiddle());
}

TEST_F(GlobeTouchTest, AnArrowPointsToACursorOutsideThePicture)
{
    ASSERT_TRUE(beginTouch(-133.0, 10.0, 1e6));
    press(globeMiddle());
    EXPECT_FALSE(overlays().handPointer()->isVisible());
    globe().setCamera(
        {.target = {.longitude = Angle::degrees(-80.0), .latitude = Angle()}, .distance_m = 2e5});
    release(globeMiddle());
    EXPECT_TRUE(globe().stylus()); // under the pointer again
    EXPECT_FALSE(overlays().handPointer()->isVisible());
}

TEST_F(GlobeTouchTest, SpaceWithTheButtonDownMovesTheGlobeWithTheHand)
{
    ASSERT_TRUE(beginTouch(-133.0, 40.0, 1e6));
    move(globeMiddle());
    press(globeMiddle());
    ASSERT_TRUE(globe().stylus() && globe().stylus()->is_in_contact);
    const StylusPose held = *globe().stylus();
    const ScenePoint grabbed = pointAt(globeMiddle());
    const double distance_m = globe().camera().distance_m;
    QTest::keyPress(&globe(), Qt::Key_Space);
    EXPECT_EQ(globe().stylus()->mode, StylusMode::Pan);
    for (int i = 1; i <= 6; ++i) {
        const QPointF at = globeMiddle() + QPointF(9.0, -4.0) * i;
        move(at, Qt::LeftButton);
        EXPECT_EQ(globe().stylus()->mode, StylusMode::Pan);
        EXPECT_EQ(globe().stylus()->proxy, held.proxy) << "the globe moves, not the place on it";
        const auto now = project(poseOf(globe().camera(), body()), globe().viewport(), grabbed);
        ASSERT_TRUE(now);
        EXPECT_NEAR(now->x, at.x(), 0.1);
        EXPECT_NEAR(now->y, at.y(), 0.1);
    }
    EXPECT_EQ(globe().camera().distance_m, distance_m);
    QTest::keyRelease(&globe(), Qt::Key_Space);
    EXPECT_EQ(globe().stylus()->mode, StylusMode::Press);
    const BodyCamera after = globe().camera();
    move(globeMiddle(), Qt::LeftButton);
    EXPECT_EQ(globe().camera(), after);
    release(globeMiddle());
}

TEST_F(GlobeTouchTest, SpaceAloneZoomsAboutTheGrabbedPlace)
{
    ASSERT_TRUE(beginTouch(-133.0, 40.0, 1e6));
    const QPointF at = globeMiddle() + QPointF(60.0, -30.0);
    move(at);
    ASSERT_TRUE(globe().stylus());
    const ScenePoint held = globe().stylus()->proxy;
    const auto where = [&] {
        return *project(poseOf(globe().camera(), body()), globe().viewport(), held);
    };
    const PixelPoint before = where();
    QTest::keyPress(&globe(), Qt::Key_Space);
    EXPECT_EQ(globe().stylus()->mode, StylusMode::Zoom);
    double distance_m = globe().camera().distance_m;
    for (int i = 1; i <= 5; ++i) {
        move(at - QPointF(0.0, 8.0 * i)); // away from the user: closer
        EXPECT_LT(globe().camera().distance_m, distance_m);
        distance_m = globe().camera().distance_m;
        EXPECT_EQ(globe().stylus()->proxy, held);
        EXPECT_NEAR(where().x, before.x, 0.5);
        EXPECT_NEAR(where().y, before.y, 0.5);
    }
    QTest::keyRelease(&globe(), Qt::Key_Space);
    EXPECT_EQ(globe().stylus()->mode, StylusMode::Hover);
}

TEST_F(GlobeTouchTest, FeelsWithTheContactModelThatIsChosen)
{
    ASSERT_TRUE(beginTouch(-133.0, 40.0, 1e6));
    const auto heightOfProxy = [this](ContactModelKind kind) {
        Preferences preferences = window_->preferences();
        preferences.contact_model = kind;
        window_->setPreferences(preferences);
        move(globeMiddle());
        press(globeMiddle());
        EXPECT_TRUE(globe().stylus() && globe().stylus()->is_in_contact);
        const BodyPlace proxy = placeOf(globe().stylus()->proxy, body());
        release(globeMiddle());
        return proxy.height_m - globe().terrain()->height(proxy.foot) * globe().exaggeration();
    };
    const double cell_m = globe().terrain()->map()->georeference().pixelHeightMeters();
    EXPECT_NEAR(heightOfProxy(kContactModelDefault), 0.0, 0.02 * cell_m);
    // The proxy is the center of a sphere on the ground.
    EXPECT_GT(heightOfProxy(ContactModelKind::VirtualProxy), 0.05 * cell_m);
    EXPECT_NEAR(heightOfProxy(kContactModelDefault), 0.0, 0.02 * cell_m);
}

TEST_F(GlobeTouchTest, OtherToolsLiftTheStylus)
{
    ASSERT_TRUE(beginTouch(-133.0, 10.0, 1e6));
    press(globeMiddle());
    ASSERT_TRUE(globe().stylus());
    tool(Tool::Orbit)->trigger();
    EXPECT_FALSE(globe().stylus());
    tool(Tool::Touch)->trigger();
    move(globeMiddle());
    EXPECT_TRUE(globe().stylus());
    scene(1)->trigger(); // the flat map
    EXPECT_FALSE(globe().stylus());
    EXPECT_TRUE(tool(Tool::Touch)->isChecked());
}

TEST_F(GlobeTouchTest, AnotherExaggerationIsFeltWhereItIsSeen)
{
    ASSERT_TRUE(beginTouch(-133.0, 18.0, 2e6));
    view().setExaggeration(8.0);
    ASSERT_TRUE(waitFor([this] { return globe().isTouchReady(); }));
    press(globeMiddle());
    ASSERT_TRUE(globe().stylus()->is_in_contact);
    const BodyPlace proxy = placeOf(globe().stylus()->proxy, body());
    EXPECT_NEAR(proxy.height_m, 8.0 * globe().terrain()->height(proxy.foot),
                0.05 * globe().terrain()->map()->georeference().pixelHeightMeters());
    release(globeMiddle());
}

} // namespace
} // namespace marsview
