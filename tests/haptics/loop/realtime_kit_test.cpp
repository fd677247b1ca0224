#include "haptics/loop/realtime_kit.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace marsview::test {
namespace {

TEST(RealtimeKit, ReportsWhyItIsUnavailable)
{
    const char* before = std::getenv("DBUS_SYSTEM_BUS_ADDRESS"); // NOLINT(concurrency-mt-unsafe)
    const std::string address = before != nullptr ? before : "";
    // NOLINTNEXTLINE(concurrency-mt-unsafe)
    setenv("DBUS_SYSTEM_BUS_ADDRESS", "unix:path=/nowhere/system_bus_socket", 1);
    const std::string reason = askRealtimeKit(20);
    if (before != nullptr) {
        setenv("DBUS_SYSTEM_BUS_ADDRESS", address.c_str(), 1); // NOLINT(concurrency-mt-unsafe)
    } else {
        unsetenv("DBUS_SYSTEM_BUS_ADDRESS"); // NOLINT(concurrency-mt-unsafe)
    }
    EXPECT_EQ(reason.rfind("RealtimeKit cannot be used: ", 0), 0U) << reason;
    EXPECT_GT(reason.size(), 32U);
}

} // namespace
} // namespace marsview::test
