#include "haptics/device/watched_call.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>

namespace marsview::test {
namespace {

using namespace std::chrono_literals;

// Slow to destroy, as a device whose driver closes its connection.
struct SlowToClose {
    std::atomic<bool>& is_closed;
    ~SlowToClose()
    {
        std::this_thread::sleep_for(50ms);
        is_closed = true;
    }
};

TEST(WatchedCall, ReturnsTheResult)
{
    EXPECT_EQ(callWatched(10s, [] { return 7; }), 7);
}

TEST(WatchedCall, DestroysWhatTheWorkOwnsBeforeItReturns)
{
    std::atomic<bool> is_closed{false};
    const auto result =
        callWatched(10s, [held = std::shared_ptr<SlowToClose>(new SlowToClose{is_closed})] {
            return held != nullptr;
        });
    EXPECT_TRUE(result.has_value());
    EXPECT_TRUE(is_closed);
}

TEST(WatchedCall, AbandonsWorkThatHangs)
{
    const auto gate = std::make_shared<std::atomic<bool>>(false);
    const auto result = callWatched(20ms, [gate] {
        while (!*gate) {
            std::this_thread::yield();
        }
        return true;
    });
    EXPECT_FALSE(result.has_value());
    *gate = true;
}

} // namespace
} // namespace marsview::test
