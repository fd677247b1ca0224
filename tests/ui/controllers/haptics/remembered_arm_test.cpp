// An arm that was unplugged is found again at another path, in the same window and in the next.
#include "haptics/drivers/polhem/polhem_driver.h"
#include "tests/haptics/drivers/fake_hid.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"
#include "tests/ui/test_map.h"
#include "tests/ui/timeout.h"
#include "ui/controllers/haptics/haptics_controller.h"
#include "ui/panels/haptics_panel.h"
#include "ui/window/window_actions.h"

#include <QApplication>
#include <QPushButton>
#include <QSettings>
#include <QTest>

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace marsview {
namespace {

using test::FakeHid;
using test::FakeHidDevice;
using test::reportOf;

const FakeHidDevice kArm{"/dev/hidraw7", 0x16C0, 0x0486, 0xFFAB, 0x0200, 0, 0, L"4711"};
const FakeHidDevice kOtherArm{"/dev/hidraw8", 0x16C0, 0x0486, 0xFFAB, 0x0200, 0, 0, L"4712"};
const FakeHidDevice kArmWithoutNumber{"/dev/hidraw5", 0x1234, 0x0006};

class RememberedArmTest : public testing::Test {
protected:
    void SetUp() override
    {
        QSettings().remove(QStringLiteral("haptics"));
        hid_.say(reportOf({0, 0, -5000, 0, 0, 256, 0}, 64));
    }
    void TearDown() override
    {
        window_.reset();
        EXPECT_EQ(hid_.openDevices(), 0U);
        QSettings().remove(QStringLiteral("haptics"));
    }

    void makeWindow()
    {
        WindowOptions options = testWindowOptions();
        options.geometry = WindowOptions::Geometry::Remembered;
        options.make_drivers = [this] {
            std::vector<std::unique_ptr<DeviceDriver>> drivers;
            drivers.push_back(std::make_unique<PolhemDriver>(PolhemOptions{
                .api = &hid_.api(),
                .parameter_files = {test::sourceRoot() / "resources/devices/polhem-v1.json"},
                .lock_folder = folder_.path() / "locks"}));
            return drivers;
        };
        window_.reset();
        window_ = std::make_unique<MainWindow>(options);
        window_->resize(1000, 700);
        window_->show();
        QApplication::setActiveWindow(window_.get()); // without a window manager
        ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    }
    HapticsController& haptics() { return window_->haptics(); }
    DeviceSession& device() { return haptics().device(); }
    bool comesTo(HapticsConnection connection)
    {
        return QTest::qWaitFor([&] { return device().connection() == connection; }, kTimeout);
    }
    bool connectTo(const QString& uri)
    {
        device().connectTo(uri);
        return comesTo(HapticsConnection::Connected);
    }
    // Unplugs it and waits until the loss is detected.
    bool unplug()
    {
        hid_.unplug();
        return comesTo(HapticsConnection::None) &&
               QTest::qWaitFor([&] { return !device().isFinding(); }, kTimeout);
    }

    TestMaps maps_;
    FakeHid hid_;
    test::TempFolder folder_;
    std::unique_ptr<MainWindow> window_;
};

TEST_F(RememberedArmTest, IsConnectedAgainUnderAnotherPath)
{
    hid_.plugIn(kOtherArm);
    hid_.plugIn(kArm);
    makeWindow();
    ASSERT_TRUE(connectTo(QStringLiteral("polhem:serial=4711")));
    EXPECT_EQ(hid_.openedPath(), "/dev/hidraw7");
    ASSERT_TRUE(unplug());
    // Both return, the other one at the path of the first.
    hid_.move("/dev/hidraw7", "/dev/hidraw3");
    hid_.move("/dev/hidraw8", "/dev/hidraw7");
    hid_.plugInAgain();
    ASSERT_TRUE(comesTo(HapticsConnection::Connected));
    EXPECT_EQ(hid_.openedPath(), "/dev/hidraw3");
    EXPECT_EQ(device().uri(), QStringLiteral("polhem:serial=4711"));
    // And in the next window, at yet another path.
    window_->close();
    hid_.move("/dev/hidraw3", "/dev/hidraw11");
    makeWindow();
    ASSERT_TRUE(comesTo(HapticsConnection::Connected));
    EXPECT_EQ(hid_.openedPath(), "/dev/hidraw11");
}

TEST_F(RememberedArmTest, IsConnectedWhenItComesAfterTheWindow)
{
    hid_.plugIn(kArmWithoutNumber);
    hid_.unplug();
    QSettings().setValue(QStringLiteral("haptics/device"), QStringLiteral("polhem:usb=1234:0006"));
    makeWindow();
    ASSERT_TRUE(comesTo(HapticsConnection::None));
    EXPECT_EQ(device().notice(), QString());
    hid_.plugInAgain();
    ASSERT_TRUE(comesTo(HapticsConnection::Connected));
    EXPECT_EQ(hid_.openedPath(), "/dev/hidraw5");
}

// At that time the user cannot confirm that the arm is in its home position.
TEST_F(RememberedArmTest, IsNotTakenToBeAtRestWhenItIsBack)
{
    hid_.plugIn(kArm);
    makeWindow();
    const QString options =
        QStringLiteral(",parameters=") +
        QString::fromStdString(test::sourceRoot() / "resources/devices/polhem-v1.json");
    ASSERT_TRUE(connectTo(QStringLiteral("polhem:serial=4711,home") + options));
    EXPECT_EQ(haptics().settings().device, QStringLiteral("polhem:serial=4711") + options);
    ASSERT_TRUE(unplug());
    hid_.plugInAgain();
    ASSERT_TRUE(comesTo(HapticsConnection::Connected));
    EXPECT_EQ(device().uri(), QStringLiteral("polhem:serial=4711") + options);
}

// The oldest boards have no home flag, and the option is the only way.
TEST_F(RememberedArmTest, AnArmThatDoesNotKnowWhereItIsIsToldByAButton)
{
    hid_.plugIn(kArmWithoutNumber);
    hid_.say(reportOf({10, 20, 30, 0}, 8));
    makeWindow();
    window_->actionSet().haptic_devices->trigger();
    ASSERT_TRUE(connectTo(QStringLiteral("polhem:usb=1234:0006")));
    auto* button = window_->hapticsPanel()->findChild<QPushButton*>(QStringLiteral("restPosition"));
    ASSERT_NE(button, nullptr);
    ASSERT_TRUE(QTest::qWaitFor([&] { return button->isVisible(); }, kTimeout));
    button->click();
    ASSERT_TRUE(comesTo(HapticsConnection::Connected));
    EXPECT_TRUE(QTest::qWaitFor([&] { return !button->isVisible(); }, kTimeout));
    EXPECT_TRUE(QTest::qWaitFor(
        [&] {
            return device().loop() != nullptr && device().loop()->state().tick > 0 &&
                   device().loop()->state().reason != ForceOffReason::DeviceUnready;
        },
        kTimeout));
    EXPECT_EQ(haptics().settings().device, QStringLiteral("polhem:usb=1234:0006"));
}

} // namespace
} // namespace marsview
