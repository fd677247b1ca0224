#include "haptics/device/guarded_device.h"
#include "haptics/device/plugin_driver.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <fstream>
#include <semaphore>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace marsview::test {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

// A folder with copies of plugins that have not been loaded before.
class PluginFolder {
public:
    // Long enough for a busy machine to load a small library; only a plugin that hangs uses it up.
    explicit PluginFolder(milliseconds patience = milliseconds(60'000))
        : patience_(patience)
    {
        fs::create_directory(plugins());
    }
    fs::path plugins() const { return folder_.path() / "plugins"; }
    fs::path add(const std::string& behaviour, const std::string& name = "x") const
    {
        const fs::path copy = plugins() / (name + ".so");
        fs::copy_file(fs::path(MARSVIEW_TEST_PLUGINS) / (behaviour + ".so"), copy,
                      fs::copy_options::overwrite_existing);
        return copy;
    }
    PluginOptions options() const
    {
        return {.folders = {folder_.path() / "nothing here", plugins()},
                .marker_folder = folder_.path() / "markers",
                .lock_folder = folder_.path() / "locks",
                .patience = patience_};
    }
    std::size_t markers() const { return count(".loading"); }
    std::size_t troubles() const { return count(".trouble"); }

private:
    std::size_t count(const std::string& ending) const
    {
        std::error_code none;
        const fs::directory_iterator files(folder_.path() / "markers", none);
        return static_cast<std::size_t>(
            std::count_if(fs::begin(files), fs::end(files), [&](const fs::directory_entry& entry) {
                return entry.path().extension() == ending;
            }));
    }

    TempFolder folder_;
    milliseconds patience_;
};

// The only device found in a folder with one plugin.
FoundDevice only(PluginDriver& driver)
{
    const std::vector<FoundDevice> found = driver.find();
    EXPECT_EQ(found.size(), 1U);
    return found.empty() ? FoundDevice{} : found.front();
}

FoundDevice foundOf(const std::string& behaviour)
{
    const PluginFolder folder;
    folder.add(behaviour);
    PluginDriver driver(folder.options());
    return only(driver);
}

std::string refusalOf(const std::string& behaviour)
{
    const PluginFolder folder;
    const fs::path file = folder.add(behaviour);
    PluginDriver driver(folder.options());
    const auto device = driver.open(file.string());
    EXPECT_FALSE(device);
    return device ? "" : device.error().message;
}

} // namespace

TEST(PluginDriver, OpensADeviceAndPassesEverythingOnInBothDirections)
{
    const PluginFolder folder;
    const fs::path file = folder.add("is_good");
    PluginDriver driver(folder.options());
    const FoundDevice found = only(driver);
    EXPECT_EQ(found.uri, "plugin:" + file.string());
    EXPECT_EQ(found.name, "Tiny");
    EXPECT_TRUE(found.isUsable()) << found.reason;

    auto device = driver.open(file.string());
    ASSERT_TRUE(device) << device.error().message;
    const DeviceCapabilities& c = (*device)->capabilities();
    EXPECT_EQ(c.name, "Tiny One");
    EXPECT_EQ(c.workspace, (WorkspaceBox{{-0.08, -0.06, -0.05}, {0.08, 0.06, 0.07}}));
    EXPECT_EQ(c.force_n_peak, 3.3);
    EXPECT_EQ(c.force_n_continuous, 0.9);
    EXPECT_EQ(c.stiffness_n_per_m_max, 1500.0);
    EXPECT_EQ(c.rate_hz, 1000.0);
    EXPECT_EQ(c.axes_in, 6);
    EXPECT_EQ(c.axes_out, 3);
    EXPECT_EQ(c.buttons, 3);
    EXPECT_TRUE(c.has_presence);
    EXPECT_FALSE(c.owns_clock);

    const auto before = std::chrono::steady_clock::now();
    EXPECT_EQ((*device)->write({1.0, -2.0, 0.5}), DeviceStatus::Fine);
    DeviceSample sample;
    EXPECT_EQ((*device)->read(sample), DeviceStatus::Fine);
    EXPECT_EQ(sample.position, (WorkspacePoint{0.001, -0.002, 0.0005}));
    EXPECT_EQ(sample.twist_rad, 0.25);
    EXPECT_EQ(sample.buttons, 4U);
    EXPECT_TRUE(sample.is_held);
    EXPECT_GE(sample.time, before);
    EXPECT_LE(sample.time, std::chrono::steady_clock::now());
}

TEST(PluginDriver, ClampsForcesToThePeakThatTheDeviceStates)
{
    const PluginFolder folder;
    PluginDriver driver(folder.options());
    auto device = driver.open(folder.add("is_good").string());
    ASSERT_TRUE(device) << device.error().message;
    EXPECT_EQ((*device)->write({0.0, 33.0, 0.0}), DeviceStatus::Fine);
    DeviceSample sample;
    EXPECT_EQ((*device)->read(sample), DeviceStatus::Fine);
    // the tiny device returns the force as its position
    EXPECT_NEAR(sample.position.y, 3.3e-3, 1e-12);
}

TEST(PluginDriver, ClosesADeviceWhenItIsDestroyed)
{
    const PluginFolder folder;
    const fs::path file = folder.add("is_good");
    PluginDriver driver(folder.options());
    auto device = driver.open(file.string());
    ASSERT_TRUE(device) << device.error().message;
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_NOLOAD);
    ASSERT_NE(library, nullptr);
    const auto* closed = static_cast<const std::atomic<int>*>(dlsym(library, "tiny_closed"));
    ASSERT_NE(closed, nullptr);
    EXPECT_EQ(closed->load(), 0);
    device->reset();
    EXPECT_EQ(closed->load(), 1);
    dlclose(library);
}

TEST(PluginDriver, FindsPluginsByTheirNamesInTheFoldersToo)
{
    const PluginFolder folder;
    folder.add("is_good", "hand");
    PluginDriver driver(folder.options());
    EXPECT_TRUE(driver.open("hand.so"));
    EXPECT_TRUE(driver.open("hand"));
    EXPECT_TRUE(driver.open((folder.plugins() / "hand").string()));
    const auto missing = driver.open("other.so");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::NotFound);
    EXPECT_THAT(missing.error().message, AllOf(StartsWith("plugin:other.so: no such plugin"),
                                               HasSubstr(folder.plugins().string())));
}

TEST(PluginDriver, TakesPathsThatHoldAHash)
{
    const PluginFolder folder;
    const fs::path file = folder.add("is_good", "a#b");
    PluginDriver driver(folder.options());
    EXPECT_TRUE(driver.open(file.string()));
    const auto other = driver.open(file.string() + "#c");
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().message,
              "plugin:" + file.string() + "#c: could not be opened: there is no c");
}

TEST(PluginDriver, ListsAllDevicesOfAPluginWithTheirReasons)
{
    const PluginFolder folder;
    const fs::path file = folder.add("has_two");
    PluginDriver driver(folder.options());
    const std::vector<FoundDevice> found = driver.find();
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[1].uri, "plugin:" + file.string() + "#b");
    EXPECT_EQ(found[1].name, "Tiny B") << "a line break";
    EXPECT_EQ(found[1].reason, "its cover is open");
    EXPECT_EQ(foundOf("has_none").reason, "none of its devices is connected");
    EXPECT_EQ(foundOf("has_none").name, "Tiny plugin");
}

TEST(PluginDriver, KeepsWorkingWithPluginsWhoseStructsHaveGrown)
{
    const PluginFolder folder;
    PluginDriver driver(folder.options());
    auto device = driver.open(folder.add("is_newer").string());
    ASSERT_TRUE(device) << device.error().message;
    DeviceSample sample;
    EXPECT_EQ((*device)->write({1.0, 0.0, 0.0}), DeviceStatus::Fine);
    EXPECT_EQ((*device)->read(sample), DeviceStatus::Fine);
    EXPECT_EQ(sample.position.x, 0.001);
}

// Compiled against the header as it was before its structs grew.
TEST(PluginDriver, OpensAPluginBuiltAgainstTheFirstHeader)
{
    const PluginFolder folder;
    const fs::path file = folder.add("is_first");
    PluginDriver driver(folder.options());
    auto device = driver.open(file.string());
    ASSERT_TRUE(device) << device.error().message;
    const DeviceCapabilities& c = (*device)->capabilities();
    EXPECT_EQ(c.name, "Tiny One");
    EXPECT_EQ(c.axes_in, 6);
    EXPECT_EQ(c.torque_nm_peak, 0.0);
    EXPECT_FALSE(c.can_set_home);
    DeviceSample sample;
    EXPECT_EQ((*device)->write({1.0, -2.0, 0.5}), DeviceStatus::Fine);
    EXPECT_EQ((*device)->read(sample), DeviceStatus::Fine);
    EXPECT_EQ(sample.position, (WorkspacePoint{0.001, -0.002, 0.0005}));
    EXPECT_EQ(sample.twist_rad, 0.25);
    EXPECT_EQ(sample.orientation, Orientation{}) << "not measured";
    EXPECT_EQ(sample.buttons, 4U);
    EXPECT_EQ((*device)->trouble(), "");
    device->reset();
    EXPECT_THAT(driver.open(file.string() + ",home").error().message,
                HasSubstr("cannot be calibrated by \",home\""));
}

TEST(PluginDriver, ShowsTheMessageOfADeviceThatIsNotReady)
{
    const PluginFolder folder;
    PluginDriver driver(folder.options());
    for (const auto& [behaviour, message] :
         {std::pair{"explains", "is not calibrated; put the stylus into its holder"},
          std::pair{"is_lost", "its cable is out"}}) {
        auto device = driver.open(folder.add(behaviour, behaviour).string());
        ASSERT_TRUE(device) << device.error().message;
        EXPECT_EQ((*device)->trouble(), "") << "nothing has been read";
        DeviceSample sample;
        EXPECT_NE((*device)->read(sample), DeviceStatus::Fine);
        EXPECT_EQ((*device)->trouble(), message);
        EXPECT_EQ((*device)->write({}),
                  behaviour == std::string("is_lost") ? DeviceStatus::Lost : DeviceStatus::Fine);
        EXPECT_EQ((*device)->trouble(), message) << "writing does not change the reason";
    }
}

TEST(PluginDriver, AsksAPluginThatHangsForItsMessageOnlyOnce)
{
    const PluginFolder folder;
    PluginDriver driver(folder.options());
    const fs::path file = folder.add("hangs_explaining");
    auto device = driver.open(file.string());
    ASSERT_TRUE(device) << device.error().message;
    DeviceSample sample;
    EXPECT_EQ((*device)->read(sample), DeviceStatus::Unready);
    for (int i = 0; i < 3; ++i) {
        EXPECT_THAT((*device)->trouble(), StartsWith("did not return from being asked"));
    }
    void* plugin = dlopen(file.c_str(), RTLD_NOW | RTLD_NOLOAD);
    ASSERT_NE(plugin, nullptr);
    EXPECT_EQ(static_cast<const std::atomic<int>*>(dlsym(plugin, "tiny_asked"))->load(), 1);
    dlclose(plugin);
}

TEST(PluginDriver, CalibratesADeviceThatTheUserHoldsInItsHomePosition)
{
    const PluginFolder folder;
    const fs::path file = folder.add("calibrates");
    PluginDriver driver(folder.options());
    DeviceSample sample;
    auto device = driver.open(file.string());
    ASSERT_TRUE(device) << device.error().message;
    EXPECT_TRUE((*device)->capabilities().can_set_home);
    EXPECT_EQ((*device)->read(sample), DeviceStatus::Unready);
    device->reset();
    device = driver.open(file.string() + ",home");
    ASSERT_TRUE(device) << device.error().message;
    EXPECT_EQ((*device)->read(sample), DeviceStatus::Fine);
    EXPECT_EQ((*device)->trouble(), "");
    device->reset();

    const fs::path other = folder.add("fails_calibrating", "fails");
    EXPECT_EQ(driver.open(other.string() + ",home").error().message,
              "plugin:" + other.string() + ",home: is not in its home position");
}

TEST(PluginDriver, PassesOrientationAndTorqueOn)
{
    const PluginFolder folder;
    PluginDriver driver(folder.options());
    auto device = driver.open(folder.add("has_six_axes").string());
    ASSERT_TRUE(device) << device.error().message;
    EXPECT_EQ((*device)->capabilities().axes_out, 6);
    EXPECT_EQ((*device)->capabilities().torque_nm_peak, 0.5);
    DeviceSample sample;
    EXPECT_EQ((*device)->write({1.0, -2.0, 0.5}), DeviceStatus::Fine);
    EXPECT_EQ((*device)->read(sample), DeviceStatus::Fine);
    EXPECT_EQ(sample.position, (WorkspacePoint{0.001, -0.002, 0.0005}));
    EXPECT_EQ(sample.twist_rad, 0.5) << "the plugin was called with force and torque together";
    EXPECT_NEAR(sample.orientation.w, std::sqrt(0.5), 1e-15);
    EXPECT_NEAR(sample.orientation.x, -std::sqrt(0.5), 1e-15);
}

TEST(PluginDriver, SaysWhyItRefusesALibrary)
{
    EXPECT_THAT(foundOf("has_other_version").reason,
                EndsWith("x.so: is built for version 2 of the plugin interface, but this program "
                         "has version 1; get a build for this version"));
    EXPECT_THAT(foundOf("lacks_symbol").reason,
                EndsWith("x.so: is not a device plugin: it has no function marsviewHapticPlugin"));
    EXPECT_THAT(foundOf("lacks_table").reason, EndsWith("x.so: returned no function table"));
    EXPECT_THAT(foundOf("lacks_read").reason, HasSubstr("x.so: lacks the function \"read\";"));
    EXPECT_THAT(foundOf("has_small_table").reason,
                HasSubstr("x.so: states that its MarsviewPlugin has 40 bytes, but 96 to"));
    EXPECT_THAT(foundOf("has_small_samples").reason,
                HasSubstr("x.so: states that its MarsviewSample has 24 bytes, but 48 to"));
    EXPECT_FALSE(foundOf("has_other_version").isUsable());
}

TEST(PluginDriver, SaysWhyItCannotLoadAFileThatIsNoLibrary)
{
    const PluginFolder folder;
    const fs::path file = folder.plugins() / "text.so";
    std::ofstream(file) << "not a library";
    PluginDriver driver(folder.options());
    const FoundDevice found = only(driver);
    EXPECT_EQ(found.name, "text.so");
    EXPECT_EQ(
        found.reason,
        file.string() +
            ": is not a library for this computer, or is damaged; get a build for this system");
    EXPECT_EQ(driver.open(file.string()).error().message, found.reason);
    EXPECT_EQ(folder.markers(), 0U);
}

TEST(PluginDriver, SaysWhyItRefusesADevice)
{
    EXPECT_THAT(refusalOf("fails_opening"),
                EndsWith("x.so: could not be opened: the cover is open"));
    EXPECT_THAT(refusalOf("is_nan"), HasSubstr("x.so: states a maximum stiffness of "));
    EXPECT_THAT(refusalOf("is_negative"), HasSubstr("x.so: states a peak force of -3 N;"));
    EXPECT_THAT(refusalOf("is_empty"),
                HasSubstr("x.so: states a workspace from -0.06 to -0.06 m along y;"));
}

TEST(PluginDriver, DropsADeviceWhoseSamplesAreNotFinite)
{
    const PluginFolder folder;
    PluginDriver driver(folder.options());
    auto device = driver.open(folder.add("says_nan").string());
    ASSERT_TRUE(device) << device.error().message;
    DeviceSample sample;
    EXPECT_EQ((*device)->read(sample), DeviceStatus::Fine);
    EXPECT_EQ((*device)->read(sample), DeviceStatus::Fine);
    const DeviceSample last = sample;
    EXPECT_EQ((*device)->read(sample), DeviceStatus::Unready);
    EXPECT_EQ((*device)->read(sample), DeviceStatus::Unready);
    EXPECT_EQ((*device)->read(sample), DeviceStatus::Lost);
    EXPECT_EQ((*device)->write({1.0, 0.0, 0.0}), DeviceStatus::Lost);
    EXPECT_EQ(sample.position, last.position) << "withheld";
    EXPECT_EQ((*device)->trouble(), "its samples contain numbers that are not finite");
}

TEST(PluginDriver, DropsADeviceThatSpeaksInMillimeters)
{
    const PluginFolder folder;
    PluginDriver driver(folder.options());
    auto device = driver.open(folder.add("says_millimetres").string());
    ASSERT_TRUE(device) << device.error().message;
    DeviceSample sample;
    EXPECT_EQ((*device)->read(sample), DeviceStatus::Unready);
    EXPECT_EQ((*device)->read(sample), DeviceStatus::Unready);
    EXPECT_EQ((*device)->read(sample), DeviceStatus::Lost);
    EXPECT_THAT((*device)->trouble(), HasSubstr("units may be wrong"));
}

TEST(PluginDriver, TakesUnknownAnswersForALostDevice)
{
    const PluginFolder folder;
    PluginDriver driver(folder.options());
    auto device = driver.open(folder.add("answers_nonsense").string());
    ASSERT_TRUE(device) << device.error().message;
    DeviceSample sample;
    EXPECT_EQ((*device)->read(sample), DeviceStatus::Lost);
    EXPECT_THAT((*device)->trouble(), HasSubstr("an unknown status"));
}

TEST(PluginDriver, LetsADeviceThatOwnsTheClockDriveTheTick)
{
    const PluginFolder folder;
    PluginDriver driver(folder.options());
    auto device = driver.open(folder.add("owns_clock").string());
    ASSERT_TRUE(device) << device.error().message;
    EXPECT_TRUE((*device)->capabilities().owns_clock);
    struct Ticks {
        HapticDevice* device;
        std::atomic<int> count{0};
        std::atomic<int> fine{0};
        std::counting_semaphore<> ten{0};
    } ticks{.device = device->get()};
    const bool has_started = (*device)->startClock(
        [](void* self, std::chrono::steady_clock::time_point) noexcept {
            auto* t = static_cast<Ticks*>(self);
            DeviceSample sample;
            t->fine += t->device->read(sample) == DeviceStatus::Fine ? 1 : 0;
            if (++t->count == 10) {
                t->ten.release();
            }
        },
        &ticks);
    ASSERT_TRUE(has_started);
    ticks.ten.acquire();
    (*device)->stopClock();
    const int count = ticks.count;
    EXPECT_GE(count, 10);
    EXPECT_EQ(ticks.fine, count);
    device->reset();
    EXPECT_EQ(ticks.count, count) << "one tick after the clock stopped";
}

TEST(PluginDriver, LeavesAPluginAloneThatHangsWhileItOpensADevice)
{
    const PluginFolder folder(milliseconds(1000));
    const fs::path file = folder.add("hangs_opening");
    PluginDriver driver(folder.options());
    EXPECT_TRUE(only(driver).isUsable());
    const auto device = driver.open(file.string());
    ASSERT_FALSE(device);
    const std::string expected = "plugin:" + file.string() +
                                 ": did not return from being opened within 1.0 s; it is "
                                 "skipped until the program restarts";
    EXPECT_EQ(device.error().message, expected);
    EXPECT_EQ(only(driver).reason, expected);
    EXPECT_EQ(driver.open(file.string()).error().message, expected) << "without another attempt";
}

TEST(PluginDriver, LeavesAPluginAloneThatHangsWhileItListsOrCloses)
{
    const PluginFolder folder(milliseconds(1000));
    folder.add("hangs_listing");
    PluginDriver driver(folder.options());
    EXPECT_THAT(only(driver).reason, HasSubstr("did not return from listing its devices"));

    const PluginFolder other;
    PluginDriver other_driver(other.options());
    auto device = other_driver.open(other.add("hangs_closing").string());
    ASSERT_TRUE(device) << device.error().message;
    device->reset(); // must return
}

using PluginDriverDeathTest = testing::Test;

TEST(PluginDriverDeathTest, LeavesOutWhatBroughtTheProgramDownUntilToldToTryAgain)
{
    struct Crash {
        const char* behaviour;
        const char* doing;
    };
    for (const Crash& crash :
         {Crash{"crashes_loading", "being loaded"}, Crash{"crashes_listing", "listing its devices"},
          Crash{"crashes_opening", "opening a device"},
          Crash{"crashes_starting", "running a device"},
          Crash{"crashes_reading", "running a device"},
          Crash{"crashes_writing", "running a device"},
          Crash{"crashes_closing", "closing a device"}}) {
        SCOPED_TRACE(crash.behaviour);
        const PluginFolder folder;
        const fs::path file = folder.add(crash.behaviour);
        EXPECT_DEATH(
            {
                PluginDriver driver(folder.options());
                (void)driver.find();
                auto device = driver.open(file.string());
                (void)(*device)->startClock(
                    [](void*, std::chrono::steady_clock::time_point) noexcept {}, nullptr);
                DeviceSample sample;
                (void)(*device)->read(sample);
                (void)(*device)->write({});
                device->reset();
            },
            "");
        EXPECT_EQ(folder.markers(), 1U);
        PluginDriver driver(folder.options());
        const auto refused = driver.open(file.string());
        ASSERT_FALSE(refused);
        EXPECT_THAT(refused.error().message,
                    AllOf(StartsWith(file.string() + ": the program ended while this plugin was " +
                                     crash.doing + " last time"),
                          EndsWith("try it again with marsview-cli devices --retry")));
        EXPECT_EQ(only(driver).reason, refused.error().message);
        EXPECT_EQ(folder.markers(), 1U) << "not tried a second time in between";

        // A different build counts as a different plugin.
        folder.add("is_good");
        EXPECT_TRUE(only(driver).isUsable());
        fs::remove(file);
        driver.forgetFailures();
        EXPECT_EQ(folder.markers(), 0U);
    }
}

TEST(PluginDriver, MarksADeviceUntilItHasRunWell)
{
    const PluginFolder folder;
    PluginDriver driver(folder.options());
    auto device = driver.open(folder.add("is_good").string());
    ASSERT_TRUE(device) << device.error().message;
    EXPECT_EQ(folder.markers(), 1U);
    DeviceSample sample;
    for (std::uint64_t i = 0; i + 1 < GuardedDevice::kReadsOfTrial; ++i) {
        ASSERT_EQ((*device)->read(sample), DeviceStatus::Fine);
    }
    EXPECT_EQ(folder.markers(), 1U);
    (void)(*device)->read(sample);
    while (folder.markers() != 0) {
        std::this_thread::yield();
    }
    device->reset();
    EXPECT_EQ(folder.markers(), 0U);
}

TEST(GuardedDevice, IsMarkedOnlyWhileItRuns)
{
    const PluginFolder folder;
    const fs::path file = folder.add("is_good");
    PluginDriver driver(folder.options());
    auto device = driver.open(file.string());
    ASSERT_TRUE(device) << device.error().message;
    for (std::uint64_t i = 0; i < GuardedDevice::kReadsOfTrial; ++i) {
        DeviceSample sample;
        ASSERT_EQ((*device)->read(sample), DeviceStatus::Fine);
    }
    while (folder.markers() != 0) {
        std::this_thread::yield();
    }
    // A second guard around it, with a short timeout.
    const fs::path markers = folder.options().marker_folder;
    auto marker = markPluginCall(markers, file, PluginCall::Run);
    ASSERT_TRUE(marker);
    GuardedDevice guarded({.device = std::move(*device),
                           .plugin = file,
                           .marker_folder = markers,
                           .marker = std::move(*marker),
                           .lock = {},
                           .idle = milliseconds(1)});
    while (folder.markers() != 0) { // until the device is read
        std::this_thread::yield();
    }
    for (bool is_marked = false; !is_marked; is_marked = folder.markers() == 1) {
        DeviceSample sample;
        (void)guarded.read(sample);
        std::this_thread::sleep_for(milliseconds(1)); // a thousand per second, as a loop does
    }
}

TEST(CrashMarker, OfOneProgramIsNeitherClearedNorBlamedByAnother)
{
    const PluginFolder folder;
    const fs::path file = folder.add("is_good");
    const fs::path markers = folder.options().marker_folder;
    int ready[2];
    int done[2];
    ASSERT_EQ(pipe(ready), 0);
    ASSERT_EQ(pipe(done), 0);
    const pid_t other = fork();
    if (other == 0) {
        const auto marker = markPluginCall(markers, file, PluginCall::Open);
        char byte = marker ? 'y' : 'n';
        (void)!write(ready[1], &byte, 1);
        (void)!read(done[0], &byte, 1);
        _exit(0); // as if the process had crashed
    }
    char byte = 0;
    ASSERT_EQ(read(ready[0], &byte, 1), 1);
    ASSERT_EQ(byte, 'y');
    {
        const auto own = markPluginCall(markers, file, PluginCall::Load);
        ASSERT_TRUE(own) << own.error().message;
        EXPECT_EQ(folder.markers(), 2U);
        CrashMarker::forget(markers);
        EXPECT_EQ(folder.markers(), 2U) << "both are in use";
    }
    EXPECT_EQ(folder.markers(), 1U);
    ASSERT_EQ(write(done[1], &byte, 1), 1);
    ASSERT_EQ(waitpid(other, nullptr, 0), other);
    const auto after = markPluginCall(markers, file, PluginCall::Load);
    ASSERT_FALSE(after);
    EXPECT_THAT(after.error().message, HasSubstr("while this plugin was opening a device"));
    for (const int end : {ready[0], ready[1], done[0], done[1]}) {
        close(end);
    }
}

TEST(PluginDriver, GivesOneDeviceToOneHolderHoweverItIsNamed)
{
    const PluginFolder folder;
    const fs::path file = folder.add("has_two");
    const fs::path link = folder.plugins() / "link.so";
    fs::create_symlink(file, link);
    PluginDriver driver(folder.options());
    auto device = driver.open("x.so");
    ASSERT_TRUE(device) << device.error().message;
    for (const fs::path& name : {file, link}) {
        const auto second = driver.open(name.string());
        ASSERT_FALSE(second);
        EXPECT_EQ(second.error().message,
                  "plugin:" + fs::canonical(file).string() +
                      ": is in use by this program already; close it there first");
    }
    EXPECT_THAT(driver.open(file.string() + "#b").error().message, HasSubstr("there is no b"))
        << "another device can be opened";
    device->reset();
    EXPECT_TRUE(driver.open(file.string()));
}

TEST(PluginDriver, SaysWhatWentWrongTheLastTimeOfADeviceThatCanBeUsed)
{
    struct Trouble {
        const char* behaviour;
        const char* said;
    };
    for (const Trouble& trouble :
         {Trouble{"fails_opening", "could not be opened: the cover is open"},
          Trouble{"hangs_opening", "did not return from being opened"},
          Trouble{"is_empty",
                  "states a workspace from -0.06 to -0.06 m along y; report it "
                  "to the plugin's makers"},
          Trouble{"says_nan", "its samples contain numbers that are not finite"},
          Trouble{"says_unready",
                  "its plugin reports that it is not ready, without a reason; check whether it "
                  "needs calibration and whether its emergency stop is pressed"}}) {
        SCOPED_TRACE(trouble.behaviour);
        const PluginFolder folder(milliseconds(1000));
        const fs::path file = folder.add(trouble.behaviour);
        PluginDriver before(folder.options());
        EXPECT_EQ(only(before).reason, "");
        if (auto device = before.open(file.string())) {
            DeviceSample sample;
            for (int i = 0; i < 5; ++i) {
                (void)(*device)->read(sample);
            }
            EXPECT_EQ(folder.troubles(), 0U) << "written during the run";
        }
        EXPECT_EQ(folder.troubles(), 1U);

        PluginDriver after(folder.options()); // another program
        const FoundDevice found = only(after);
        EXPECT_EQ(found.reason, std::string("last time it was used: ") + trouble.said);
        EXPECT_TRUE(found.isUsable());
    }
}

TEST(PluginDriver, ForgetsTheTroubleOfADeviceThatWorkedSince)
{
    const PluginFolder folder;
    const fs::path file = fs::canonical(folder.add("is_good"));
    LastTrouble(folder.options().marker_folder, "plugin:" + file.string()).set("it was cold");
    PluginDriver driver(folder.options());
    EXPECT_EQ(only(driver).reason, "last time it was used: it was cold");
    auto device = driver.open("x.so"); // a different name for the same plugin
    ASSERT_TRUE(device) << device.error().message;
    DeviceSample sample;
    EXPECT_EQ((*device)->read(sample), DeviceStatus::Fine);
    device->reset();
    EXPECT_EQ(only(driver).reason, "");
    EXPECT_EQ(folder.troubles(), 0U);
}

TEST(PluginDriver, SaysOfOtherDevicesOfAPluginNothing)
{
    const PluginFolder folder;
    const fs::path file = folder.add("has_two");
    PluginDriver driver(folder.options());
    EXPECT_FALSE(driver.open(file.string() + "#b"));
    const std::vector<FoundDevice> found = driver.find();
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].reason, "");
    EXPECT_EQ(found[1].reason, "its cover is open") << "the current reason takes precedence";
    EXPECT_FALSE(found[1].isUsable());
}

TEST(PluginDriver, HasAReasonWhereThePluginGivesNone)
{
    const PluginFolder folder;
    PluginDriver driver(folder.options());
    auto device = driver.open(folder.add("says_unready").string());
    ASSERT_TRUE(device) << device.error().message;
    EXPECT_EQ((*device)->trouble(), "");
    DeviceSample sample;
    EXPECT_EQ((*device)->read(sample), DeviceStatus::Unready);
    EXPECT_THAT((*device)->trouble(), StartsWith("its plugin reports that it is not ready"));
}

TEST(PluginDriverDeathTest, ComesToAnEndAlthoughAPluginHangsAndTriesItAgainAtTheNextStart)
{
    struct Hang {
        const char* behaviour;
        const char* doing;
    };
    for (const Hang& hang : {Hang{"hangs_loading", "did not return from being loaded"},
                             Hang{"hangs_listing", "did not return from listing its devices"},
                             Hang{"hangs_opening", "did not return from being opened"},
                             Hang{"hangs_reading", "read"}}) {
        SCOPED_TRACE(hang.behaviour);
        const PluginFolder folder(milliseconds(1000));
        const fs::path file = folder.add(hang.behaviour);
        EXPECT_EXIT(
            {
                PluginDriver driver(folder.options());
                auto device = driver.open(file.string());
                if (device) {
                    // Runs detached, like the servo thread, so that the driver does not wait for
                    // it.
                    std::binary_semaphore begun{0};
                    std::thread([&] {
                        begun.release();
                        DeviceSample sample;
                        (void)(*device)->read(sample);
                    }).detach();
                    begun.acquire();
                }
                const std::string said = device ? "read" : device.error().message;
                const bool is_right = said.find(hang.doing) != std::string::npos;
                std::exit(is_right && folder.markers() == 1 ? 7 : 8);
            },
            testing::ExitedWithCode(7), "");
        EXPECT_EQ(folder.markers(), 0U);
    }
}

TEST(PluginDriverDeathTest, LeavesOutWhatEndsTheProgramFromWithin)
{
    const PluginFolder folder;
    const fs::path file = folder.add("exits_opening");
    EXPECT_EXIT(
        {
            PluginDriver driver(folder.options());
            (void)driver.open(file.string());
        },
        testing::ExitedWithCode(3), "");
    EXPECT_EQ(folder.markers(), 1U);
    PluginDriver driver(folder.options());
    EXPECT_THAT(only(driver).reason, HasSubstr("ended while this plugin was opening a device"));
}

using CrashMarkerDeathTest = testing::Test;

TEST(CrashMarkerDeathTest, OfAnEarlierProcessWithTheSameNumberStays)
{
    const PluginFolder folder;
    const fs::path crashed = folder.add("is_good", "crashed");
    const fs::path hanging = folder.add("is_good", "hanging");
    const fs::path markers = folder.options().marker_folder;
    EXPECT_EXIT(
        {
            std::string left;
            {
                const auto marker = markPluginCall(markers, crashed, PluginCall::Load);
                left = fs::directory_iterator(markers)->path().string();
            }
            std::ofstream(left) << getpid() << '\n'; // without a lock on the file
            const auto marker = markPluginCall(markers, hanging, PluginCall::Load);
            std::exit(marker && folder.markers() == 2 ? 7 : 8);
        },
        testing::ExitedWithCode(7), "");
    EXPECT_EQ(folder.markers(), 1U);
    EXPECT_FALSE(markPluginCall(markers, crashed, PluginCall::Load));
    EXPECT_TRUE(markPluginCall(markers, hanging, PluginCall::Load));
}

TEST(PluginOptions, LookIntoChosenUsersAndSystemsFoldersInThisOrder)
{
    setenv("MARSVIEW_PLUGIN_PATH", "/a::/b", 1);
    setenv("XDG_DATA_HOME", "/data", 1);
    const std::vector<fs::path> folders = PluginOptions::standard().folders;
    unsetenv("MARSVIEW_PLUGIN_PATH");
    unsetenv("XDG_DATA_HOME");
    ASSERT_EQ(folders.size(), 4U);
    EXPECT_EQ(folders[0], "/a");
    EXPECT_EQ(folders[1], "/b");
    EXPECT_EQ(folders[2], "/data/marsview/plugins");
    EXPECT_TRUE(folders[3].is_absolute());
    EXPECT_THAT(folders[3].string(), EndsWith("/marsview/plugins"));
}

TEST(PluginOptions, FindTheFoldersOfTheInstallationThatTheProgramLiesIn)
{
    const TempFolder prefix;
    for (const char* name :
         {"bin", "lib/marsview/plugins", "lib64/marsview/plugins",
          "lib/x86_64-linux-gnu/marsview/plugins", "libexec/marsview", "share/marsview/plugins"}) {
        fs::create_directories(prefix.path() / name);
    }
    const fs::path root = fs::canonical(prefix.path());
    EXPECT_THAT(installedPluginFolders(prefix.path() / "bin"),
                testing::UnorderedElementsAre(root / "lib/marsview/plugins",
                                              root / "lib64/marsview/plugins",
                                              root / "lib/x86_64-linux-gnu/marsview/plugins"));
    EXPECT_TRUE(installedPluginFolders(prefix.path() / "nowhere" / "bin").empty());
}

} // namespace marsview::test
