#include "core/base/round_numbers.h"
#include "tests/support/random.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

namespace marsview {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Reads the digits of the number instead of computing with it.
bool isRound(double value)
{
    char text[40];
    std::snprintf(text, sizeof text, "%.14e", value);
    const std::string digits(text, 16);
    return digits == "1.00000000000000" || digits == "2.00000000000000" ||
           digits == "5.00000000000000";
}

TEST(RoundNumber, EnclosesAnyValueClosely)
{
    test::Random random;
    for (int i = 0; i < 20000; ++i) {
        const double value = std::pow(10.0, random.uniform(-20.0, 20.0));
        const double below = roundNumberBelow(value);
        const double above = roundNumberAbove(value);
        ASSERT_TRUE(isRound(below)) << below;
        ASSERT_TRUE(isRound(above)) << above;
        ASSERT_LE(below, value * (1.0 + 2e-9));
        ASSERT_GT(below * 2.5 * (1.0 + 2e-9), value);
        ASSERT_GE(above, value * (1.0 - 2e-9));
        ASSERT_LT(above, value * 2.5 * (1.0 + 2e-9));
    }
}

TEST(RoundNumber, IsItsOwnNeighbor)
{
    for (const double value : {0.001, 0.02, 0.5, 1.0, 2.0, 5.0, 10.0, 2e3, 5e6, 1e15}) {
        EXPECT_EQ(roundNumberBelow(value), value);
        EXPECT_EQ(roundNumberAbove(value), value);
        EXPECT_EQ(roundNumberAbove(value * (1.0 + 1e-12)), value) << "one rounding too many";
    }
}

TEST(RoundNumber, ReportsItsDecimals)
{
    EXPECT_EQ(decimalsOf(5000.0), 0);
    EXPECT_EQ(decimalsOf(1.0), 0);
    EXPECT_EQ(decimalsOf(0.5), 1);
    EXPECT_EQ(decimalsOf(0.1), 1);
    EXPECT_EQ(decimalsOf(0.002), 3);
}

TEST(RoundTicks, AreRoundNumbers)
{
    EXPECT_THAT(roundTicks(-8068.0, 21171.0, 7).values,
                ElementsAre(-5000.0, 0.0, 5000.0, 10000.0, 15000.0, 20000.0));
    EXPECT_THAT(roundTicks(0.0, 60.0, 5).values, ElementsAre(0.0, 20.0, 40.0, 60.0));
    EXPECT_THAT(roundTicks(0.0, 0.32, 5).values, ElementsAre(0.0, 0.1, 0.2, 0.3));
}

TEST(RoundTicks, AreAllMultiplesOfTheSmallestStepThatFits)
{
    test::Random random;
    for (int i = 0; i < 20000; ++i) {
        const double width = std::pow(10.0, random.uniform(-6.0, 6.0));
        const double low = random.uniform(-20.0, 20.0) * width;
        const double high = low + width;
        const int count_max = 1 + static_cast<int>(random.below(12));
        const RoundTicks ticks = roundTicks(low, high, count_max);
        ASSERT_TRUE(isRound(ticks.step)) << ticks.step;
        ASSERT_LE(ticks.values.size(), static_cast<std::size_t>(count_max));
        // Counted step by step, from a multiple that is certainly below.
        std::size_t count = 0;
        const double finer = roundNumberBelow(ticks.step * 0.9);
        std::size_t finer_count = 0;
        for (int k = -1; k <= static_cast<int>(width / finer) + 1; ++k) {
            const double fine = (std::floor(low / finer) + k) * finer;
            finer_count += fine >= low && fine <= high ? 1 : 0;
            const double coarse = (std::floor(low / ticks.step) + k) * ticks.step;
            count += coarse >= low && coarse <= high ? 1 : 0;
        }
        ASSERT_EQ(ticks.values.size(), count) << low << " … " << high << " by " << ticks.step;
        ASSERT_GT(finer_count, static_cast<std::size_t>(count_max));
        for (std::size_t k = 0; k < ticks.values.size(); ++k) {
            const double share = ticks.values[k] / ticks.step;
            ASSERT_NEAR(share, std::round(share), 1e-9);
            ASSERT_GE(ticks.values[k], low);
            ASSERT_LE(ticks.values[k], high);
            ASSERT_TRUE(k == 0 || ticks.values[k] > ticks.values[k - 1]);
        }
    }
}

TEST(RoundTicks, HaveNoNegativeZero)
{
    for (const double value : roundTicks(-1.0, 1.0, 5).values) {
        EXPECT_FALSE(value == 0.0 && std::signbit(value));
    }
}

TEST(RoundTicks, AreEmptyWithoutARange)
{
    const double nan = std::nan("");
    const double huge = std::numeric_limits<double>::max();
    EXPECT_THAT(roundTicks(3.0, 3.0, 5).values, IsEmpty());
    EXPECT_THAT(roundTicks(4.0, 3.0, 5).values, IsEmpty());
    EXPECT_THAT(roundTicks(nan, 3.0, 5).values, IsEmpty());
    EXPECT_THAT(roundTicks(0.0, HUGE_VAL, 5).values, IsEmpty());
    EXPECT_THAT(roundTicks(-huge, huge, 5).values, IsEmpty());
    EXPECT_THAT(roundTicks(1e15, 1e15 + 0.25, 5).values, IsEmpty());
    EXPECT_THAT(roundTicks(0.0, 1.0, 0).values, IsEmpty());
    EXPECT_THAT(roundTicks(0.0, 1e-310, 5).values, IsEmpty());
}

} // namespace
} // namespace marsview
