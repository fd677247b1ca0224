#include "core/base/plain_number.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace marsview::test {
namespace {

TEST(PlainNumber, EveryDoubleReadsBackAsItself)
{
    Random random;
    for (int i = 0; i < 100'000; ++i) {
        const double value = std::bit_cast<double>(random.bits());
        if (std::isnan(value)) {
            continue;
        }
        ASSERT_EQ(parseNumber(asText(value)), value) << asText(value);
    }
}

TEST(PlainNumber, HasAPointAndNoMoreDigitsThanNeeded)
{
    EXPECT_EQ(asText(1500.0), "1500.0");
    EXPECT_EQ(asText(0.1), "0.1");
    EXPECT_EQ(asText(-2.5), "-2.5");
    EXPECT_EQ(asText(std::numeric_limits<double>::quiet_NaN()), "nan");
}

TEST(PlainNumber, ReadsCommonSpellingsAndNothingElse)
{
    EXPECT_EQ(parseNumber("+3.5e2"), 350.0);
    EXPECT_TRUE(std::isnan(parseNumber("nan").value_or(0.0)));
    EXPECT_TRUE(std::isinf(parseNumber("-inf").value_or(0.0)));
    for (const char* text : {"", "1,5", "1 ", " 1", "1m", "one", "--1"}) {
        EXPECT_FALSE(parseNumber(text)) << text;
    }
}

} // namespace
} // namespace marsview::test
