#include "haptics/sync/triple_buffer.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>

namespace marsview {
namespace {

TEST(TripleBuffer, ReaderKeepsTheInitialValueUntilSomethingIsPublished)
{
    TripleBuffer<int> buffer(7);
    EXPECT_FALSE(buffer.take());
    EXPECT_EQ(buffer.front(), 7);
    buffer.back() = 8;
    EXPECT_FALSE(buffer.take());
    EXPECT_EQ(buffer.front(), 7);
}

TEST(TripleBuffer, ReaderTakesTheLatestAndSkipsTheRest)
{
    TripleBuffer<int> buffer(0);
    for (int i = 1; i <= 5; ++i) {
        buffer.back() = i;
        buffer.publish();
        EXPECT_FALSE(buffer.isTaken());
    }
    EXPECT_EQ(buffer.front(), 0) << "not before it is taken";
    EXPECT_TRUE(buffer.take());
    EXPECT_TRUE(buffer.isTaken());
    EXPECT_EQ(buffer.front(), 5);
    EXPECT_FALSE(buffer.take());
    EXPECT_EQ(buffer.front(), 5);
}

TEST(TripleBuffer, ReaderKeepsItsValueHoweverMuchIsPublished)
{
    TripleBuffer<std::shared_ptr<int>> buffer;
    buffer.back() = std::make_shared<int>(1);
    const std::weak_ptr<int> first = buffer.back();
    buffer.publish();
    ASSERT_TRUE(buffer.take());
    for (int i = 2; i < 10; ++i) {
        buffer.back() = std::make_shared<int>(i);
        buffer.publish();
        EXPECT_FALSE(first.expired());
        EXPECT_EQ(*buffer.front(), 1);
    }
    ASSERT_TRUE(buffer.take());
    EXPECT_EQ(*buffer.front(), 9);
    EXPECT_FALSE(first.expired()) << "freed by the writer, not the reader";
    buffer.publish();
    buffer.back() = nullptr;
    EXPECT_TRUE(first.expired());
}

TEST(TripleBuffer, ReaderNeverSeesATornOrOlderValue)
{
    using Value = std::array<std::uint64_t, 64>;
    constexpr std::uint64_t kLast = 200'000;
    TripleBuffer<Value> buffer(Value{});
    std::thread writer([&buffer] {
        for (std::uint64_t i = 1; i <= kLast; ++i) {
            buffer.back().fill(i);
            buffer.publish();
        }
    });
    std::uint64_t last = 0;
    std::uint64_t torn = 0;
    std::uint64_t older = 0;
    while (last < kLast) {
        const bool is_new = buffer.take();
        const Value& value = buffer.front();
        for (const std::uint64_t word : value) {
            torn += word != value[0] ? 1U : 0U;
        }
        older += value[0] < last || is_new != (value[0] > last) ? 1U : 0U;
        last = value[0];
    }
    writer.join();
    EXPECT_EQ(torn, 0U);
    EXPECT_EQ(older, 0U);
}

} // namespace
} // namespace marsview
