// A map in tiles on the globe, touched with the mouse and with a device.
#include "core/globe/body_camera.h"
#include "tests/support/map_maker.h"
#include "tests/ui/globe/globe_window.h"
#include "tests/ui/large_maps.h"
#include "tests/ui/test_device.h"
#include "ui/controllers/haptics/haptics_controller.h"

#include <cmath>
#include <memory>

namespace marsview {
namespace {

class GlobeTiledTouchTest : public GlobeTest {
protected:
    void SetUp() override
    {
        WindowOptions options = testWindowOptions();
        options.opener = large_.opener();
        options.make_drivers = testDrivers(hand_);
        makeWindow(kSmall, options);
        large_.finishPreparing();
        ASSERT_TRUE(openAndWait(*window_, QString::fromStdString(test::bundledMars())));
        ASSERT_TRUE(waitFor([this] {
            return view().map() && view().map()->heightfield().isTiled() &&
                   !window_->controller().isBusy();
        }));
        truth_ = test::loadedMap(test::bundledMars());
    }
    void TearDown() override { window_.reset(); }

    bool showGlobe(double longitude_deg, double latitude_deg)
    {
        if (!GlobeTest::showGlobe()) {
            return false;
        }
        globe().setCamera({.target = {.longitude = Angle::degrees(longitude_deg),
                                      .latitude = Angle::degrees(latitude_deg)},
                           .distance_m = 1e6});
        return true;
    }
    // The proxy is on the terrain of the map in memory: no coarser level is touched any more.
    bool isOnTruth()
    {
        const auto& pose = globe().shownStylus();
        if (!pose || !pose->is_in_contact) {
            return false;
        }
        const BodyPlace proxy = placeOf(pose->proxy, body());
        return std::abs(proxy.height_m - truth_->height(proxy.foot) * globe().exaggeration()) <
               0.02 * truth_->georeference().pixelHeightMeters();
    }

    LargeMaps large_;
    std::shared_ptr<TestHand> hand_ = std::make_shared<TestHand>();
    std::shared_ptr<const Map> truth_;
};

TEST_F(GlobeTiledTouchTest, TheMousePressesIntoTheTerrainOfTheMapInMemory)
{
    // Next to the seam between the last column and the first.
    ASSERT_TRUE(showGlobe(0.05, 12.0));
    window_->actionSet().tools->actions().at(static_cast<int>(Tool::Touch))->trigger();
    ASSERT_TRUE(waitFor([this] { return globe().isTouchReady(); }));
    const auto send = [this](QEvent::Type type, Qt::MouseButtons buttons) {
        QMouseEvent event(type, globeMiddle(), globe().mapToGlobal(globeMiddle()), Qt::LeftButton,
                          buttons, Qt::NoModifier);
        QApplication::sendEvent(&globe(), &event);
    };
    send(QEvent::MouseButtonPress, Qt::LeftButton);
    EXPECT_TRUE(waitFor([this] { return isOnTruth(); }));
    for (int x = -60; x <= 60; x += 20) {
        move(globeMiddle() + QPointF(x, 5.0), Qt::LeftButton);
        EXPECT_TRUE(waitFor([this] { return isOnTruth(); })) << x;
    }
    send(QEvent::MouseButtonRelease, Qt::NoButton);
}

TEST_F(GlobeTiledTouchTest, ADeviceTouchesTheTerrainOfTheMapInMemory)
{
    ASSERT_TRUE(showGlobe(-112.0, 2.0));
    DeviceSession& device = window_->haptics().device();
    device.connectTo(QStringLiteral("hand:"));
    ASSERT_TRUE(waitFor([&] { return device.isRunning() && globe().shownStylus(); }));
    EXPECT_TRUE(window_->haptics().whyApart().isEmpty());
    hand_->moveTo({0.0, 0.0, -0.055});
    EXPECT_TRUE(waitFor([&] { return hand_->force_n > 0.5 && isOnTruth(); }));
    device.disconnectDevice();
}

} // namespace
} // namespace marsview
