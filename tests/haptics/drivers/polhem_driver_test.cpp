// The whole driver for WoodenHaptics and Polhem arms, against simulated HID devices.
#include "haptics/device/home_option.h"
#include "haptics/drivers/polhem/polhem_driver.h"
#include "haptics/drivers/polhem/polhem_report.h"
#include "tests/haptics/drivers/fake_hid.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>

namespace marsview::test {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;

constexpr std::size_t kRawHidBytes = 64;
const FakeHidDevice kTeensy{"/dev/hidraw7", 0x16C0, 0x0486, 0xFFAB, 0x0200};
const FakeHidDevice kOlderBoard{"/dev/hidraw8", 0x1234, 0x0006};

// At home: the upper body is level and points toward the user, with its tip at (0, 0.007, 0.132).
FakeHid::Report atHome(std::size_t bytes = kRawHidBytes)
{
    return reportOf({0, 0, -5000, 0, 0, 256, 0}, bytes);
}

int int16In(const FakeHid::Report& report, std::size_t index)
{
    const std::size_t at = 1 + 2 * index;
    return static_cast<std::int16_t>(
        static_cast<std::uint16_t>(report.at(at) | (report.at(at + 1) << 8)));
}

class PolhemDriverTest : public testing::Test {
protected:
    PolhemOptions options() const
    {
        return {.api = &hid_.api(),
                .parameter_files = {folder_.path() / "none.json",
                                    sourceRoot() / "resources/devices/polhem-v1.json"},
                .lock_folder = folder_.path() / "locks"};
    }
    // By default with the option that declares the arm to be in its home position.
    HapticDevice& open(std::string_view address = ",home")
    {
        PolhemDriver driver(options());
        auto device = driver.open(address);
        EXPECT_TRUE(device) << device.error().message;
        opened_ = std::move(*device);
        return *opened_;
    }
    std::string refusal(std::string_view address = "")
    {
        PolhemDriver driver(options());
        const auto device = driver.open(address);
        EXPECT_FALSE(device);
        return device ? "" : device.error().message;
    }
    bool comesTo(DeviceStatus wanted)
    {
        return hid_.waitUntil([&] { return opened_->read(sample_) == wanted; });
    }
    // Like the loop: writes repeatedly, to keep the watchdog quiet, until this current is sent.
    bool sends(const Vec3& force_n, std::size_t motor, int ma)
    {
        return hid_.waitUntil([&] {
            (void)opened_->read(sample_);
            (void)opened_->write(force_n);
            const FakeHid::Report report = hid_.lastWritten();
            return report.size() > 7 && int16In(report, motor) == ma;
        });
    }

    FakeHid hid_;
    TempFolder folder_;
    DeviceSample sample_;
    std::unique_ptr<HapticDevice> opened_;
};

} // namespace

TEST(PolhemReport, ReadsBothLayoutsAndRefusesShortOnes)
{
    const auto long_one = parsePolhemReport(reportOf({1, -2, 300, -400, 5, -32768, 1}, 64));
    ASSERT_TRUE(long_one);
    EXPECT_EQ(long_one->encoders, (PolhemEncoders{1, -2, 300, -400, 5, -32768}));
    EXPECT_TRUE(long_one->wants_calibration);
    const auto short_one = parsePolhemReport(reportOf({1, -2, 300, -400, 5, 6, 0}, 14));
    ASSERT_TRUE(short_one);
    EXPECT_EQ(short_one->encoders, (PolhemEncoders{1, -2, 300, -400, 5, 6}));
    EXPECT_FALSE(short_one->wants_calibration);
    const auto oldest = parsePolhemReport(reportOf({1, -2, 300, 1}, 8));
    ASSERT_TRUE(oldest);
    EXPECT_EQ(oldest->encoders, (PolhemEncoders{1, -2, 300, 0, 0, 0}));
    EXPECT_FALSE(oldest->wants_calibration);
    for (const std::size_t bytes : {0U, 1U, 7U, 9U, 13U}) {
        EXPECT_FALSE(parsePolhemReport(reportOf({1, 2, 3, 4, 5, 6, 7}, bytes))) << bytes;
    }
}

TEST(PolhemReport, WritesCurrentsAndEncodersAsTheBoardsReadThem)
{
    const PolhemCommand currents =
        polhemCurrentCommand(PolhemLayout::RawHid, {0.258, -1.5, 1000.0});
    ASSERT_EQ(currents.size, 65U);
    EXPECT_EQ(currents.bytes[0], 0);    // the number of the report
    EXPECT_EQ(currents.bytes[1], 0x02); // 258 = 0x0102
    EXPECT_EQ(currents.bytes[2], 0x01);
    EXPECT_EQ(currents.bytes[3], 0x24); // -1500 = 0xFA24
    EXPECT_EQ(currents.bytes[4], 0xFA);
    EXPECT_EQ(currents.bytes[5], 0xFF); // 32767
    EXPECT_EQ(currents.bytes[6], 0x7F);
    EXPECT_EQ(currents.bytes[7], 0); // no command

    const PolhemCommand home =
        polhemHomeCommand(PolhemLayout::Short, PolhemEncoders{1, 2, -5000, 4, 5, 6});
    ASSERT_EQ(home.size, 15U);
    const FakeHid::Report expected = reportOf({4, 5, 6, 1, 1, 2, -5000}, 15, {0});
    EXPECT_TRUE(std::equal(expected.begin(), expected.end(), home.bytes.begin()));

    EXPECT_EQ(polhemCurrentCommand(PolhemLayout::Oldest, {}).size, 9U);
}

TEST_F(PolhemDriverTest, ListsArmsAndWhyOneMayNotBeOpened)
{
    hid_.plugIn({"/dev/hidraw1", 0x046D, 0xC077});                    // a mouse
    hid_.plugIn({"/dev/hidraw6", 0x16C0, 0x0486, 0xFFC9, 0x0004, 1}); // the Teensy's serial port
    hid_.plugIn(kTeensy);
    FakeHidDevice older = kOlderBoard;
    older.access_error = EACCES;
    hid_.plugIn(older);
    PolhemDriver driver(options());
    const std::vector<FoundDevice> found = driver.find();
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].uri, "polhem:usb=16c0:0486");
    EXPECT_EQ(found[0].name, "WoodenHaptics or Polhem (Fake)");
    EXPECT_TRUE(found[0].isUsable());
    EXPECT_EQ(found[1].reason,
              "no permission to open /dev/hidraw8; install "
              "70-marsview-haptics.rules into /etc/udev/rules.d and plug the "
              "device in again");
    EXPECT_EQ(refusal("/dev/hidraw8"), "polhem:/dev/hidraw8: " + found[1].reason);
}

TEST_F(PolhemDriverTest, FindsAnArmAgainUnderAnotherPath)
{
    FakeHidDevice one = kTeensy;
    one.serial = L"4711";
    FakeHidDevice other = kTeensy;
    other.path = "/dev/hidraw9";
    other.serial = L"4712";
    hid_.plugIn(one);
    hid_.plugIn(other);
    hid_.plugIn(kOlderBoard);
    const auto uris = [this] {
        PolhemDriver driver(options());
        std::vector<std::string> all;
        for (const FoundDevice& device : driver.find()) {
            all.push_back(device.uri);
        }
        std::sort(all.begin(), all.end());
        return all;
    };
    const std::vector<std::string> before = uris();
    EXPECT_EQ(before, (std::vector<std::string>{"polhem:serial=4711", "polhem:serial=4712",
                                                "polhem:usb=1234:0006"}));
    // Two devices swap paths, and the third one gets a new path.
    hid_.move("/dev/hidraw7", "/dev/hidraw20");
    hid_.move("/dev/hidraw9", "/dev/hidraw7");
    hid_.move("/dev/hidraw20", "/dev/hidraw9");
    hid_.move("/dev/hidraw8", "/dev/hidraw2");
    EXPECT_EQ(uris(), before);
    for (const auto& [address, path] :
         {std::pair{"serial=4711", "/dev/hidraw9"}, std::pair{"serial=4712,home", "/dev/hidraw7"},
          std::pair{"usb=1234:0006", "/dev/hidraw2"}, std::pair{"/dev/hidraw7", "/dev/hidraw7"}}) {
        (void)open(address);
        EXPECT_EQ(hid_.openedPath(), path) << address;
        opened_.reset();
    }
    EXPECT_THAT(refusal("serial=4713"),
                HasSubstr("polhem:serial=4713: no matching WoodenHaptics or Polhem device is "
                          "connected"));
    EXPECT_THAT(refusal("usb=16c0:0486"), HasSubstr("no matching WoodenHaptics"))
        << "these have numbers";
}

TEST_F(PolhemDriverTest, TellsArmsApartByTheirPathsWhereNothingElseDoes)
{
    hid_.plugIn(kTeensy);
    FakeHidDevice other = kTeensy;
    other.path = "/dev/hidraw9";
    other.serial = L"not, a: number"; // unusable in a URI
    hid_.plugIn(other);
    FakeHidDevice copy = kOlderBoard;
    copy.serial = L"1";
    hid_.plugIn(copy);
    copy.path = "/dev/hidraw10";
    hid_.plugIn(copy);
    PolhemDriver driver(options());
    std::vector<std::string> uris;
    for (const FoundDevice& device : driver.find()) {
        uris.push_back(device.uri);
    }
    EXPECT_THAT(uris, testing::UnorderedElementsAre("polhem:/dev/hidraw7", "polhem:/dev/hidraw9",
                                                    "polhem:/dev/hidraw8", "polhem:/dev/hidraw10"));
}

TEST_F(PolhemDriverTest, OpensNoneOfTheArmsThatShareAName)
{
    FakeHidDevice copy = kTeensy;
    copy.serial = L"4711";
    hid_.plugIn(copy);
    copy.path = "/dev/hidraw9";
    hid_.plugIn(copy);
    hid_.plugIn(kOlderBoard); // without a serial number
    FakeHidDevice another = kOlderBoard;
    another.path = "/dev/hidraw10";
    hid_.plugIn(another);
    EXPECT_THAT(refusal("serial=4711,home"),
                testing::AnyOf("polhem:serial=4711,home: 2 devices match that name; choose one by "
                               "its path: polhem:/dev/hidraw7 or polhem:/dev/hidraw9",
                               "polhem:serial=4711,home: 2 devices match that name; choose one by "
                               "its path: polhem:/dev/hidraw9 or polhem:/dev/hidraw7"));
    EXPECT_THAT(refusal("usb=1234:0006"),
                AllOf(HasSubstr("polhem:/dev/hidraw8"), HasSubstr("polhem:/dev/hidraw10")));
    EXPECT_EQ(hid_.openDevices(), 0U);
    (void)open("/dev/hidraw9");
    EXPECT_EQ(hid_.openedPath(), "/dev/hidraw9");
}

TEST_F(PolhemDriverTest, TellsWhereTheHandIsAndPushesIt)
{
    hid_.plugIn(kTeensy);
    hid_.say(atHome());
    HapticDevice& device = open("/dev/hidraw7,home");
    EXPECT_EQ(device.capabilities().name, "Polhem v1");
    EXPECT_EQ(device.capabilities().axes_in, 6);
    ASSERT_TRUE(comesTo(DeviceStatus::Fine));
    EXPECT_NEAR(sample_.position.x, 0.0, 1e-12);
    EXPECT_NEAR(sample_.position.y, 0.007, 1e-12);
    EXPECT_NEAR(sample_.position.z, 0.132, 1e-12);
    EXPECT_NEAR(sample_.twist_rad, -1.5707963267948966, 1e-12);
    EXPECT_EQ(device.trouble(), "");
    // 1 N up: 0.133 N·m at the joint, a tenth of it at the motor, over 0.0538 N·m/A: 247 mA.
    EXPECT_TRUE(sends({0.0, 0.0, 1.0}, 2, -247));
    EXPECT_EQ(hid_.lastWritten().size(), 65U);
    // 1 N away from the user: the lower body, 0.174 N·m: 323 mA.
    EXPECT_TRUE(sends({0.0, 1.0, 0.0}, 1, 323));
}

TEST_F(PolhemDriverTest, LetsGoWhenTheLoopStopsWriting)
{
    hid_.plugIn(kTeensy);
    hid_.say(atHome());
    (void)open();
    ASSERT_TRUE(sends({0.0, 0.0, 1.0}, 2, -247));
    EXPECT_TRUE(hid_.waitUntil([&] { return int16In(hid_.lastWritten(), 2) == 0; }));
    EXPECT_TRUE(comesTo(DeviceStatus::Fine)) << "it keeps reading";
}

TEST_F(PolhemDriverTest, LetsGoWhenTheBoardFallsSilentAndGoesOnWithIt)
{
    hid_.plugIn(kTeensy);
    hid_.say(atHome());
    HapticDevice& device = open();
    ASSERT_TRUE(sends({0.0, 0.0, 1.0}, 2, -247));
    hid_.say({});
    EXPECT_TRUE(comesTo(DeviceStatus::Unready));
    EXPECT_THAT(device.trouble(), HasSubstr("sends no complete reports"));
    EXPECT_TRUE(sends({0.0, 0.0, 1.0}, 2, 0)) << "however large the requested force";
    hid_.say(atHome());
    EXPECT_TRUE(sends({0.0, 0.0, 1.0}, 2, -247));
}

TEST_F(PolhemDriverTest, TakesShortReportsForSilence)
{
    hid_.plugIn(kTeensy);
    hid_.say(reportOf({0, 0, -5000, 0, 0, 0}, 12));
    (void)open();
    // Hundreds of such reports, and none is used.
    const std::size_t before = hid_.writes();
    ASSERT_TRUE(hid_.waitUntil([&] { return hid_.writes() > before + 200; }));
    EXPECT_EQ(opened_->read(sample_), DeviceStatus::Unready);
    hid_.say(atHome());
    EXPECT_TRUE(comesTo(DeviceStatus::Fine));
}

TEST_F(PolhemDriverTest, IsLostWhenItIsUnplugged)
{
    hid_.plugIn(kTeensy);
    hid_.say(atHome());
    HapticDevice& device = open();
    ASSERT_TRUE(sends({0.0, 0.0, 1.0}, 2, -247));
    hid_.unplug();
    EXPECT_TRUE(comesTo(DeviceStatus::Lost));
    EXPECT_EQ(device.write({0.0, 0.0, 1.0}), DeviceStatus::Lost);
    EXPECT_THAT(device.trouble(), HasSubstr("unplugged"));
    EXPECT_TRUE(hid_.waitUntil([&] { return hid_.openDevices() == 0; }));
}

TEST_F(PolhemDriverTest, AnswersTheLoopWhileTheBusStalls)
{
    hid_.plugIn(kTeensy);
    hid_.say(atHome());
    HapticDevice& device = open();
    ASSERT_TRUE(comesTo(DeviceStatus::Fine));
    hid_.stallWriting();
    // Eventually the other thread is in a write that does not return, and no sample is new.
    DeviceSample last;
    int same = 0;
    ASSERT_TRUE(hid_.waitUntil([&] {
        EXPECT_EQ(device.read(sample_), DeviceStatus::Fine);
        EXPECT_EQ(device.write({0.0, 0.0, 1.0}), DeviceStatus::Fine);
        same = sample_.time == last.time ? same + 1 : 0;
        last = sample_;
        return same >= 20;
    })) << "the age of the sample informs the loop";
    hid_.goOnWriting();
    EXPECT_TRUE(hid_.waitUntil([&] {
        (void)device.read(sample_);
        return sample_.time > last.time;
    }));
}

TEST_F(PolhemDriverTest, LeavesTheMotorsWithoutCurrent)
{
    hid_.plugIn(kTeensy);
    hid_.say(atHome());
    (void)open();
    ASSERT_TRUE(sends({0.0, 0.0, 1.0}, 2, -247));
    opened_.reset();
    EXPECT_EQ(hid_.openDevices(), 0U);
    for (std::size_t motor = 0; motor < 3; ++motor) {
        EXPECT_EQ(int16In(hid_.lastWritten(), motor), 0);
    }
}

TEST_F(PolhemDriverTest, ClampsWhatTheLoopAsksFor)
{
    hid_.plugIn(kTeensy);
    hid_.say(atHome());
    (void)open();
    // 50 N are clamped to 5 N, which needs 1236 mA; the current never exceeds 2 A.
    EXPECT_TRUE(sends({0.0, 0.0, 50.0}, 2, -1236));
    for (const FakeHid::Report& report : hid_.written()) {
        for (std::size_t motor = 0; motor < 3; ++motor) {
            ASSERT_LE(std::abs(int16In(report, motor)), 2000);
        }
    }
}

TEST_F(PolhemDriverTest, IsUnreadyUntilItsEncodersHaveBeenSet)
{
    hid_.plugIn(kTeensy);
    hid_.say(reportOf({1, 0, -2, 0, 0, 0, 0}, kRawHidBytes)); // as after power-on
    HapticDevice& device = open("");
    ASSERT_TRUE(hid_.waitUntil([&] { return hid_.writes() > 20; }));
    EXPECT_EQ(device.read(sample_), DeviceStatus::Unready);
    EXPECT_THAT(device.trouble(), HasSubstr("is not calibrated"));
    EXPECT_TRUE(sends({0.0, 0.0, 1.0}, 2, 0));
    // The board's button is pressed: the report requests that the encoders be set.
    hid_.say(reportOf({1, 0, -2, 0, 0, 0, 1}, kRawHidBytes));
    const FakeHid::Report home = reportOf({0, 0, 0, 1, 0, 0, -5000}, 65, {0});
    EXPECT_TRUE(hid_.waitUntil([&] { return hid_.lastWritten() == home; }));
    hid_.say(atHome());
    EXPECT_TRUE(comesTo(DeviceStatus::Fine));
    EXPECT_NEAR(sample_.position.z, 0.132, 1e-12);
}

TEST_F(PolhemDriverTest, DoesNotTakeANudgedArmForACalibratedOne)
{
    hid_.plugIn(kTeensy);
    // The state after power-on and some motion, and a state that looks calibrated. Both may be
    // wrong.
    for (const FakeHid::Report& report :
         {reportOf({40, 5, -12, 0, 0, 0, 0}, kRawHidBytes), atHome()}) {
        hid_.say(report);
        HapticDevice& device = open("/dev/hidraw7");
        const std::size_t before = hid_.writes();
        ASSERT_TRUE(hid_.waitUntil([&] { return hid_.writes() > before + 20; }));
        EXPECT_EQ(device.read(sample_), DeviceStatus::Unready);
        EXPECT_THAT(device.trouble(), HasSubstr("is not calibrated"));
        EXPECT_TRUE(sends({0.0, 0.0, 1.0}, 2, 0));
        opened_.reset();
    }
}

TEST_F(PolhemDriverTest, DoesNotBelieveThatItIsAtRestWhereItsEncodersSayOtherwise)
{
    hid_.plugIn(kTeensy);
    hid_.say(reportOf({0, 101, -2500, 0, 0, 0, 0}, kRawHidBytes));
    HapticDevice& device = open(",home");
    const std::size_t before = hid_.writes();
    ASSERT_TRUE(hid_.waitUntil([&] { return hid_.writes() > before + 20; }));
    EXPECT_EQ(device.read(sample_), DeviceStatus::Unready);
    EXPECT_THAT(device.trouble(), HasSubstr("do not read the counts of its home position"));
    for (const FakeHid::Report& report : hid_.written()) {
        EXPECT_EQ(int16In(report, 3), 0) << "no command";
    }
    // The button is trusted.
    hid_.sayOnce(reportOf({0, 101, -2500, 0, 0, 0, 1}, kRawHidBytes));
    hid_.say(atHome());
    EXPECT_TRUE(comesTo(DeviceStatus::Fine));
}

TEST_F(PolhemDriverTest, DoesNotBelieveABoardThatDoesNotSetItsEncoders)
{
    hid_.plugIn(kTeensy);
    hid_.say(reportOf({0, 0, 0, 0, 0, 0, 0}, kRawHidBytes));
    HapticDevice& device = open(",home");
    EXPECT_TRUE(hid_.waitUntil(
        [&] { return device.trouble().find("has not set its encoders") != std::string::npos; }));
    EXPECT_EQ(device.read(sample_), DeviceStatus::Unready);
    EXPECT_TRUE(sends({0.0, 0.0, 1.0}, 2, 0));
}

TEST_F(PolhemDriverTest, ForgetsItsCalibrationWithItsPower)
{
    hid_.plugIn(kTeensy);
    hid_.say(atHome());
    HapticDevice& device = open();
    ASSERT_TRUE(comesTo(DeviceStatus::Fine));
    hid_.say(reportOf({20, -150, -4900, 0, 0, 256, 0}, kRawHidBytes)); // a centimeter away
    ASSERT_TRUE(hid_.waitUntil(
        [&] { return device.read(sample_) == DeviceStatus::Fine && sample_.position.x != 0.0; }));
    hid_.say({});
    ASSERT_TRUE(comesTo(DeviceStatus::Unready));
    hid_.say(reportOf({0, 1, 0, 0, 0, 0, 0}, kRawHidBytes));
    EXPECT_TRUE(hid_.waitUntil(
        [&] { return device.trouble().find("is not calibrated") != std::string::npos; }));
    EXPECT_EQ(device.read(sample_), DeviceStatus::Unready);
    EXPECT_TRUE(sends({0.0, 0.0, 1.0}, 2, 0));
}

TEST_F(PolhemDriverTest, SetsTheEncodersAtOnceWhenToldTo)
{
    hid_.plugIn(kTeensy);
    hid_.say(reportOf({0, 0, 0, 0, 0, 0, 0}, kRawHidBytes));
    (void)open("/dev/hidraw7,home");
    const FakeHid::Report home = reportOf({0, 0, 0, 1, 0, 0, -5000}, 65, {0});
    EXPECT_TRUE(hid_.waitUntil([&] {
        const auto written = hid_.written();
        return std::find(written.begin(), written.end(), home) != written.end();
    }));
}

TEST_F(PolhemDriverTest, SpeaksTheOlderLayoutsToo)
{
    hid_.plugIn(kOlderBoard);
    hid_.say(atHome(14));
    (void)open();
    ASSERT_TRUE(comesTo(DeviceStatus::Fine));
    EXPECT_NEAR(sample_.position.z, 0.132, 1e-12);
    EXPECT_TRUE(sends({0.0, 0.0, 1.0}, 2, -247));
    EXPECT_EQ(hid_.lastWritten().size(), 15U);
    opened_.reset();

    // The oldest boards cannot set their encoders: the driver subtracts the readings at home.
    hid_.say(reportOf({10, 20, 30, 0}, 8));
    (void)open("/dev/hidraw8,home");
    ASSERT_TRUE(comesTo(DeviceStatus::Fine));
    EXPECT_NEAR(sample_.position.y, 0.007, 1e-12);
    EXPECT_NEAR(sample_.position.z, 0.132, 1e-12);
    EXPECT_TRUE(sends({0.0, 0.0, 1.0}, 2, -247));
    EXPECT_EQ(hid_.lastWritten().size(), 9U);
}

TEST(PolhemUri, IsRememberedWithoutBeingAtHome)
{
    EXPECT_EQ(lastingUri("polhem:/dev/hidraw7,home"), "polhem:/dev/hidraw7");
    EXPECT_EQ(lastingUri("polhem:,home,parameters=/a.json,home"), "polhem:,parameters=/a.json");
    EXPECT_EQ(lastingUri("polhem:,parameters=/a,homely.json"), "polhem:,parameters=/a,homely.json");
    EXPECT_EQ(lastingUri("polhem:/dev/hidraw7"), "polhem:/dev/hidraw7");
    EXPECT_EQ(lastingUri("plugin:x,home"), "plugin:x");
    EXPECT_EQ(lastingUri("record:x,home"), "record:x,home");
}

TEST_F(PolhemDriverTest, SaysWhatItCannotOpen)
{
    EXPECT_THAT(refusal(),
                HasSubstr("polhem:: no matching WoodenHaptics or Polhem device is connected"));
    hid_.plugIn(kTeensy);
    EXPECT_THAT(refusal("/dev/hidraw9"), HasSubstr("no matching WoodenHaptics"));
    EXPECT_EQ(refusal("/dev/hidraw7,speed=3"),
              "polhem:/dev/hidraw7,speed=3: unknown part \"speed=3\"; use a path, "
              "\"serial=NUMBER\", \"home\" or \"parameters=FILE\"");
    EXPECT_THAT(refusal("/dev/hidraw7,parameters=/nowhere.json"),
                HasSubstr("/nowhere.json: the device's parameters cannot be read"));
    hid_.refuseToOpen();
    EXPECT_EQ(refusal(),
              "polhem:: /dev/hidraw7 is listed, but cannot be opened as a HID device; plug "
              "it in again");
}

TEST_F(PolhemDriverTest, GivesOneArmToOneHolderOnly)
{
    hid_.plugIn(kTeensy);
    hid_.say(atHome());
    (void)open();
    EXPECT_THAT(refusal("/dev/hidraw7"),
                EndsWith("hidraw7: is in use by this program already; close it there first"));
    opened_.reset();
    (void)open("/dev/hidraw7");
}

} // namespace marsview::test
