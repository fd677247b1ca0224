#include "haptics/device/device_registry.h"
#include "haptics/drivers/built_in_drivers.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace marsview::test {
namespace {

// A driver whose devices only report how they were opened.
class SpokenDriver final : public DeviceDriver {
public:
    SpokenDriver(std::string scheme, std::vector<FoundDevice> devices)
        : scheme_(std::move(scheme))
        , devices_(std::move(devices))
    {}
    std::string_view scheme() const noexcept override { return scheme_; }
    std::vector<FoundDevice> find() override { return devices_; }
    Result<std::unique_ptr<HapticDevice>> open(std::string_view address) override
    {
        return Error{ErrorCode::NotFound, scheme_ + " was asked for " + std::string(address)};
    }

private:
    std::string scheme_;
    std::vector<FoundDevice> devices_;
};

DeviceRegistry twoDrivers()
{
    std::vector<std::unique_ptr<DeviceDriver>> drivers;
    drivers.push_back(std::make_unique<SpokenDriver>(
        "one", std::vector<FoundDevice>{{"one:a", "A", ""}, {"one:b", "B", "b is broken"}}));
    drivers.push_back(std::make_unique<SpokenDriver>(
        "two", std::vector<FoundDevice>{{"two:", "The only one", ""}}));
    return DeviceRegistry(std::move(drivers));
}

TEST(FoundDevice, MatchesItsUriWithOptionsAndItsScheme)
{
    const FoundDevice arm{.uri = "polhem:serial=4711", .name = "", .reason = ""};
    for (const char* wanted : {"polhem:serial=4711", "polhem:serial=4711,parameters=/a.json",
                               "polhem:", "polhem:,parameters=/a.json"}) {
        EXPECT_TRUE(arm.isMeantBy(wanted)) << wanted;
    }
    for (const char* wanted :
         {"", "polhem", "polhem:serial=47", "polhem:serial=47110", "polhem:/dev/hidraw2",
          "polhem:serial=4712", "other:serial=4711", "polhem:parameters=/a.json"}) {
        EXPECT_FALSE(arm.isMeantBy(wanted)) << wanted;
    }
    const FoundDevice hand{.uri = "sim:", .name = "", .reason = ""};
    EXPECT_TRUE(hand.isMeantBy("sim:"));
    EXPECT_TRUE(hand.isMeantBy("sim:speed=0.2"));
    EXPECT_FALSE(hand.isMeantBy("simulated:"));
}

TEST(DeviceRegistry, ListsTheDevicesOfAllDriversWithTheirReasons)
{
    DeviceRegistry registry = twoDrivers();
    const std::vector<FoundDevice> found = registry.find();
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].uri, "one:a");
    EXPECT_TRUE(found[0].isUsable());
    EXPECT_EQ(found[1].reason, "b is broken");
    EXPECT_FALSE(found[1].isUsable());
    EXPECT_EQ(found[2].uri, "two:");
}

TEST(DeviceRegistry, LeavesEverythingAfterTheFirstColonToTheDriver)
{
    DeviceRegistry registry = twoDrivers();
    const auto device = registry.open("two:/dev/x:1,speed=2:3");
    ASSERT_FALSE(device);
    EXPECT_EQ(device.error().message, "two was asked for /dev/x:1,speed=2:3");
    EXPECT_EQ(registry.open("one:").error().message, "one was asked for ");
}

TEST(DeviceRegistry, NamesTheKnownSchemesWhereOneIsUnknownOrMissing)
{
    DeviceRegistry registry = twoDrivers();
    EXPECT_EQ(registry.open("three:x").error().message,
              "three:x: no driver has the scheme \"three\"; the known schemes are one, two");
    EXPECT_EQ(registry.open("three:x").error().code, ErrorCode::Unsupported);
    EXPECT_EQ(registry.open("one").error().message,
              "one: is not a device URI; a URI begins with a scheme and a colon; "
              "the known schemes are one, two");
    EXPECT_EQ(registry.open("").error().code, ErrorCode::Invalid);
    EXPECT_EQ(registry.open(":x").error().code, ErrorCode::Unsupported);
}

TEST(BuiltInDrivers, HaveSchemesOfTheirOwn)
{
    std::set<std::string> schemes;
    for (const auto& driver : builtInDrivers()) {
        EXPECT_TRUE(schemes.insert(std::string(driver->scheme())).second) << driver->scheme();
        EXPECT_EQ(driver->scheme().find(':'), std::string_view::npos);
        EXPECT_FALSE(driver->scheme().empty());
    }
}

} // namespace
} // namespace marsview::test
